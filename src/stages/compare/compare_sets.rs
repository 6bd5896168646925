//! Counts holes and spill between two sets of leaf bits.

use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// Words of the counts: holes, spill, cells in both.
pub const COUNT_WORDS: u64 = 3;

pub fn record(gpu: &Gpu, frame: &mut Recorder, moved: &GpuBuffer, exact: &GpuBuffer, counts: &GpuBuffer) {
    frame.clear(counts);
    let words = exact.bytes() / 4;
    frame
        .pass(&gpu.kernel("compare/compare_sets.wgsl", &[]))
        .bind("moved", moved)
        .bind("exact", exact)
        .bind("counts", counts)
        .bytes_moved(8 * words)
        .dispatch(words);
}
