//! The tests of the core: one module an area, one binary so that it links once.

mod accumulation;
mod averaging;
mod device;
mod gpu;
mod loading;
mod mutations;
mod octree;
mod random;
mod shaders;
mod stage_checks;
mod stage_rig;
mod transform;
mod voxelization;
mod voxelization_payload;
