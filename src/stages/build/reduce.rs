//! Reduces the two pyramids of masks by one level: O(l), truly occupied, and A(l), to be allocated
//! (the dummies of section 4.4 included).

use super::LevelParams;
use crate::data::octree::{OctreeSizes, mask_words};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// The masks that a build reads and writes.
#[derive(Clone, Debug)]
pub struct Masks {
    pub leaf_bits: GpuBuffer,
    pub occupied: GpuBuffer,
    pub blocks: GpuBuffer,
    pub counters: GpuBuffer,
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
