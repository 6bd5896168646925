//! The tests of the core: one module an area, one binary so that it links once.

mod device;
mod gpu;
mod loading;
mod shaders;
mod voxelization;
mod voxelization_payload;
mod voxelization_surface;
