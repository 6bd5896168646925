//! What lives between stages, each with its memory layout drawn.

pub mod grid;
pub mod packing;
pub mod voxel_cache;
