//! Copies a buffer: nothing that reads and writes memory can be faster.

use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// What a thread copies.
const BYTES_A_THREAD: u64 = 16;

/// Copies the first `bytes`, a multiple of 16.
pub fn record(gpu: &Gpu, frame: &mut Recorder, original: &GpuBuffer, duplicate: &GpuBuffer, bytes: u64) {
    frame
        .pass(&gpu.kernel("bench/copy.wgsl", &[]))
        .bind("original", original)
        .bind("duplicate", duplicate)
        .bytes_moved(2 * bytes)
        .dispatch(bytes / BYTES_A_THREAD);
}
