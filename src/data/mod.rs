//! What lives between stages, each with its memory layout drawn.

pub mod albedo;
pub mod fragments;
pub mod grid;
pub mod light;
pub mod matrix;
pub mod mesh;
pub mod octree;
pub mod octree_buffers;
pub mod packing;
pub mod pages;
pub mod slot;
pub mod surface_image;
pub mod texels;
pub mod voxel_cache;
pub mod world_voxels;
