//! First half of a prefix sum: chunks to sums.

use super::{SCAN_CHUNK, ScanParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    constants: [(&str, f64); 2],
    count: u32,
    values: &GpuBuffer,
    sums: &GpuBuffer,
) {
    frame
        .pass(&gpu.kernel("build/scan_sum.wgsl", &constants))
        .uniform("params", &ScanParams { count })
        .bind("values", values)
        .bind("sums", sums)
        .bytes_moved(4 * u64::from(count))
        .dispatch(u64::from(count.div_ceil(SCAN_CHUNK)));
}
