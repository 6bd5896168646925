//! Writes block keys and child pointers in key order.

use super::LevelParams;
use crate::data::octree::{OctreeParams, OctreeSizes, TopologyBuffers, mask_words};
use crate::gpu::{Counted, Gpu, GpuBuffer, GpuError, Recorder};

/// What the scan has made room for.
#[derive(Clone, Debug)]
pub struct Emitted {
    pub block_keys: GpuBuffer,
    pub first_child: GpuBuffer,
    pub block_counts: GpuBuffer,
}

impl Emitted {
    pub fn new(gpu: &Gpu, sizes: &OctreeSizes, topology: &mut TopologyBuffers) -> Result<Self, GpuError> {
        let octree = &sizes.params;
        let bytes = |words: u64, count: u32| 4 * words * u64::from(count);
        Ok(Self {
            block_keys: topology.block_keys.ensure(gpu, "block keys", bytes(1, octree.block_count))?,
            first_child: topology.first_child.ensure(gpu, "child pointers", bytes(1, octree.inner_node_count))?,
            block_counts: topology.block_counts.ensure(gpu, "leaves of blocks", bytes(2, octree.leaf_block_count))?,
        })
    }
}

/// Before the levels: nodes have no children but those that are written.
pub fn record_start(frame: &mut Recorder, octree: &OctreeSizes, out: &Emitted) {
    frame.clear_part(&out.first_child, 4 * u64::from(octree.params.inner_node_count));
}

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeSizes,
    (blocks, ranks, leaf_bits): (&GpuBuffer, &GpuBuffer, &GpuBuffer),
    out: &Emitted,
    level: u32,
) {
    let words = u64::from(mask_words(level));
    frame
        .pass(&gpu.kernel("build/emit.wgsl", &[]))
        .bind("octree", &octree.buffer)
        .uniform("params", &LevelParams { level })
        .bind("blocks", blocks)
        .bind("ranks", ranks)
        .bind("leaf_bits", leaf_bits)
        .bind("block_keys", &out.block_keys)
        .bind("first_child", &out.first_child)
        .bind("block_counts", &out.block_counts)
        .counted(&octree.buffer, move |octree: &OctreeParams| Counted {
            threads: words,
            bytes: words * 8 + 8 * u64::from(octree.block_count_of(level)),
        })
        .dispatch(words);
}
