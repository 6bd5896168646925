//! Emission of the sorted voxels, and which leaf blocks emit.

use super::Filling;
use crate::data::light::EmissionBuffers;
use crate::data::octree::{OctreeParams, OctreeSizes};
use crate::data::pages::ListedVoxels;
use crate::gpu::{Counted, Gpu, GpuBuffer, GpuError, Recorder};

/// Emission on its way from caches to leaves.
#[derive(Clone, Debug)]
pub struct Emission {
    /// By record; parts know their first.
    pub cache_emission: GpuBuffer,
    pub sorted_emission: GpuBuffer,
    pub emitting_blocks: GpuBuffer,
    pub leaf_emission: GpuBuffer,
    /// Voxels with a place among the sorted ones.
    pub voxels: u32,
}

impl Emission {
    pub fn new(
        gpu: &Gpu,
        buffers: &mut EmissionBuffers,
        octree: &OctreeSizes,
        (cache_emission, voxels): (GpuBuffer, u32),
    ) -> Result<Self, GpuError> {
        let blocks = u64::from(octree.params.leaf_block_count);
        let leaves = u64::from(octree.params.leaf_count);
        Ok(Self {
            cache_emission,
            sorted_emission: buffers.sorted_emission.ensure(gpu, "sorted emission", 8 * u64::from(voxels))?,
            emitting_blocks: buffers.emitting_blocks.ensure(gpu, "emitting blocks", 4 * blocks)?,
            voxels,
            leaf_emission: buffers.leaf_emission.ensure(gpu, "leaf emission", 12 * leaves)?,
        })
    }
}

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &ListedVoxels,
    octree: &OctreeSizes,
    fill: &Filling,
    emission: &Emission,
) {
    let threads = u64::from(voxels.threads);
    frame.clear_part(&emission.emitting_blocks, 4 * u64::from(octree.params.leaf_block_count));
    frame
        .pass(&gpu.kernel("fill/place_emission.wgsl", &[]))
        .bind("work_items", &voxels.work_items)
        .bind("work_hints", &voxels.work_hints)
        .bind("parts", &voxels.parts)
        .bind("cache_emission", &emission.cache_emission)
        .bind("places", &fill.places)
        .bind("block_starts", &fill.block_starts)
        .bind("sorted_emission", &emission.sorted_emission)
        .bind("emitting_blocks", &emission.emitting_blocks)
        .counted(&octree.buffer, move |octree: &OctreeParams| Counted {
            threads,
            bytes: threads * (8 + 8 + 8) + 4 * u64::from(octree.leaf_block_count),
        })
        .dispatch(threads);
}
