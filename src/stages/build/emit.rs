//! Writes block keys and child pointers in key order.

use super::LevelParams;
use crate::data::octree::{OctreeParams, mask_words};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// What the scan has made room for.
#[derive(Clone, Debug)]
pub struct Emitted {
    pub block_keys: GpuBuffer,
    pub first_child: GpuBuffer,
    pub block_counts: GpuBuffer,
}

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeParams,
    (blocks, ranks, leaf_bits): (&GpuBuffer, &GpuBuffer, &GpuBuffer),
    out: &Emitted,
    level: u32,
) {
    let words = u64::from(mask_words(level));
    frame
        .pass(&gpu.kernel("build/emit.wgsl", &[]))
        .uniform("octree", octree)
        .uniform("params", &LevelParams { level })
        .bind("blocks", blocks)
        .bind("ranks", ranks)
        .bind("leaf_bits", leaf_bits)
        .bind("block_keys", &out.block_keys)
        .bind("first_child", &out.first_child)
        .bind("block_counts", &out.block_counts)
        .bytes_moved(words * 8 + 8 * u64::from(octree.block_count_of(level)))
        .dispatch(words);
}
