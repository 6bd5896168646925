//! Averages one level's light into the level above.

use super::LitOctree;
use crate::data::light::LIGHT_BYTES;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::settings::lighting::Opacity;
use crate::stages::build::LevelParams;

/// Writes all inner levels, from the leaves up.
pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, opacity: Opacity, light: &GpuBuffer) {
    for level in (0..octree.params.depth).rev() {
        record_level(gpu, frame, octree, opacity, light, level);
    }
}

fn record_level(gpu: &Gpu, frame: &mut Recorder, octree: &LitOctree, opacity: Opacity, light: &GpuBuffer, level: u32) {
    let params = &octree.params;
    let is_directional = opacity == Opacity::Directional;
    let nodes = u64::from(params.node_count(level));
    let children =
        if level + 1 == params.depth { u64::from(params.leaf_count) } else { u64::from(params.node_count(level + 1)) };
    let entries = if is_directional { 2 } else { 1 };
    frame
        .pass(&gpu.kernel("light/average_light.wgsl", &[("DIRECTIONAL", f64::from(u8::from(is_directional)))]))
        .uniform("octree", params)
        .uniform("params", &LevelParams { level })
        .bind("first_child", &octree.first_child)
        .bind("leaf_bits", &octree.leaf_bits)
        .bind("block_keys", &octree.block_keys)
        .bind("block_starts", &octree.block_starts)
        .bind("nodes", &octree.nodes)
        .bind("light", light)
        .bytes_moved(nodes * (4 + 8) + (nodes + children) * entries * LIGHT_BYTES)
        .dispatch(nodes);
}
