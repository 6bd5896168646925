//! Averages one level into the level above.

use crate::data::octree::OctreeParams;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::stages::build::LevelParams;

/// Writes `level`, at most depth − 2.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeParams,
    first_child: &GpuBuffer,
    nodes: &GpuBuffer,
    level: u32,
) {
    let count = u64::from(octree.node_count(level));
    frame
        .pass(&gpu.kernel("averaging/average.wgsl", &[]))
        .uniform("octree", octree)
        .uniform("params", &LevelParams { level })
        .bind("first_child", first_child)
        .bind("nodes", nodes)
        .bytes_moved(count * (4 + 16) + u64::from(octree.node_count(level + 1)) * 16)
        .dispatch(count);
}
