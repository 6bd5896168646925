//! Gathers the blocks that hold too many voxels for one thread, a workgroup a block.

use super::Filling;
use crate::data::octree::OctreeSizes;
use crate::gpu::{Gpu, Recorder};
use crate::settings::Filter;

/// Workgroups that share the heavy blocks; with none to do they end at once.
const GROUPS: u64 = 64;

pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &OctreeSizes, filter: Filter, fill: &Filling) {
    let kernel = gpu.kernel("fill/gather_heavy.wgsl", &[("SPLIT", filter.is_split())]);
    let threads = GROUPS * u64::from(kernel.workgroup_size[0]);
    let pass = frame.pass(&kernel);
    fill.bind_sources(pass, octree)
        .bind("leaves", &fill.leaves)
        .bind("nodes", &fill.nodes)
        .bind("heavy_blocks", &fill.heavy_blocks)
        .dispatch(threads);
}
