//! Marks the leaves that voxels touch, and counts the weight that falls outside the grid.

use crate::data::octree::OctreeSizes;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::settings::Filter;
use crate::stages::transform::MovingVoxels;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &MovingVoxels,
    octree: &OctreeSizes,
    filter: Filter,
    leaf_bits: &GpuBuffer,
    counters: &GpuBuffer,
) {
    let threads = u64::from(voxels.threads());
    frame.clear(leaf_bits);
    frame.clear(counters);
    frame
        .pass(&gpu.kernel("build/mark.wgsl", &[("SPLIT", filter.is_split())]))
        .bind("octree", &octree.buffer)
        .bind("work_items", &voxels.work_items)
        .bind("work_hints", &voxels.work_hints)
        .bind("world_voxels", &voxels.world_voxels)
        .bind("leaf_bits", leaf_bits)
        .bind("counters", counters)
        .bytes_moved(threads * 16 + leaf_bits.bytes())
        .dispatch(threads);
}
