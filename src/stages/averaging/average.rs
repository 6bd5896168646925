//! Averages one level into the level above.

use crate::data::octree::{OctreeParams, OctreeSizes};
use crate::gpu::{Counted, Gpu, GpuBuffer, Recorder};
use crate::stages::build::LevelParams;

/// Writes `level`, at most depth − 2.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeSizes,
    first_child: &GpuBuffer,
    nodes: &GpuBuffer,
    level: u32,
) {
    frame
        .pass(&gpu.kernel("averaging/average.wgsl", &[]))
        .bind("octree", &octree.buffer)
        .uniform("params", &LevelParams { level })
        .bind("first_child", first_child)
        .bind("nodes", nodes)
        .counted(&octree.buffer, move |octree: &OctreeParams| {
            let threads = u64::from(octree.node_count(level));
            Counted { threads, bytes: threads * (4 + 16) + u64::from(octree.node_count(level + 1)) * 16 }
        })
        .dispatch(octree.params.node_count(level).into());
}
