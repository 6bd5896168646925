//! Fills the leaves (section 4.3's "moving weighted average", here exact and order-free): a counting
//! sort of the world voxels by leaf block, then one thread a block gathers integer sums.

pub mod count;
pub mod count_ref;
pub mod gather;
pub mod gather_emission;
pub mod gather_emission_ref;
pub mod gather_heavy;
pub mod gather_heavy_ref;
pub mod gather_ref;
pub mod number_objects;
pub mod number_objects_ref;
pub mod place;
pub mod place_emission;
pub mod place_emission_ref;
pub mod place_ref;

use crate::gpu::GpuBuffer;

/// What gathering reads and writes; see `data::octree`.
#[derive(Clone, Debug)]
pub struct Filling {
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_keys: GpuBuffer,
    pub block_counts: GpuBuffer,
    pub block_starts: GpuBuffer,
    pub places: GpuBuffer,
    pub sorted_voxels: GpuBuffer,
    pub leaves: GpuBuffer,
    pub nodes: GpuBuffer,
    pub heavy_blocks: GpuBuffer,
}
