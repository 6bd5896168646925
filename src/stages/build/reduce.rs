//! Reduces the two pyramids of masks by one level: O(l), truly occupied, and A(l), to be allocated
//! (the dummies of section 4.4 included).

use super::{COUNTERS, LevelParams};
use crate::data::octree::{MaskBuffers, OctreeParams, OctreeSizes, mask_words};
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};

/// The masks that a build reads and writes.
#[derive(Clone, Debug)]
pub struct Masks {
    pub leaf_bits: GpuBuffer,
    pub occupied: GpuBuffer,
    pub blocks: GpuBuffer,
    pub counters: GpuBuffer,
}

impl Masks {
    /// As large as the shape of an octree asks for.
    pub fn new(gpu: &Gpu, octree: &OctreeParams, buffers: &mut MaskBuffers) -> Result<Self, GpuError> {
        let words = |count: u32| 4 * u64::from(count);
        Ok(Self {
            leaf_bits: buffers.leaf_bits.ensure(gpu, "leaf bits", (1_u64 << (3 * octree.depth)) / 8)?,
            occupied: buffers.occupied.ensure(gpu, "occupied masks", words(octree.occupied_words()))?,
            blocks: buffers.blocks.ensure(gpu, "block masks", words(octree.blocks_words()))?,
            counters: buffers.counters.ensure(gpu, "counters", 8 * u64::from(COUNTERS))?,
        })
    }
}

pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &OctreeSizes, masks: &Masks, level: u32) {
    let words = u64::from(mask_words(level));
    let made = if level >= octree.params.dense_level { 2 } else { 1 };
    frame
        .pass(&gpu.kernel("build/reduce.wgsl", &[]))
        .bind("octree", &octree.buffer)
        .uniform("params", &LevelParams { level })
        .bind("leaf_bits", &masks.leaf_bits)
        .bind("occupied", &masks.occupied)
        .bind("blocks", &masks.blocks)
        .bind("counters", &masks.counters)
        .bytes_moved(words * 4 * 9 * made)
        .dispatch(words);
}
