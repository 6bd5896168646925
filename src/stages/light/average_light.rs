//! Averages one level's light into the level above.

use super::LitOctree;
use crate::data::light::LIGHT_BYTES;
use crate::data::octree::OctreeParams;
use crate::gpu::{Counted, Gpu, GpuBuffer, Recorder};
use crate::settings::lighting::Opacity;
use crate::stages::build::LevelParams;

/// Writes all inner levels, from the leaves up.
pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, opacity: Opacity, light: &GpuBuffer) {
    for level in (0..octree.sizes.params.depth).rev() {
        record_level(gpu, frame, octree, opacity, light, level);
    }
}

fn record_level(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, opacity: Opacity, light: &GpuBuffer, level: u32) {
    let is_directional = opacity.is_directional();
    let entries = if is_directional { 2 } else { 1 };
    frame
        .pass(&gpu.kernel("light/average_light.wgsl", &[("DIRECTIONAL", f64::from(u8::from(is_directional)))]))
        .bind("octree", &octree.sizes.buffer)
        .uniform("params", &LevelParams { level })
        .bind("first_child", &octree.first_child)
        .bind("leaf_bits", &octree.ranked.leaf_bits)
        .bind("block_keys", &octree.block_keys)
        .bind("block_starts", &octree.ranked.block_starts)
        .bind("nodes", &octree.nodes)
        .bind("light", light)
        .counted(&octree.sizes.buffer, move |octree: &OctreeParams| {
            let nodes = u64::from(octree.node_count(level));
            let is_last = level + 1 == octree.depth;
            let children = u64::from(if is_last { octree.leaf_count } else { octree.node_count(level + 1) });
            Counted { threads: nodes, bytes: nodes * (4 + 8) + (nodes + children) * entries * LIGHT_BYTES }
        })
        .dispatch(octree.sizes.params.node_count(level).into());
}
