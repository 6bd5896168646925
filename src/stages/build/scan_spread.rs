//! Second half of a prefix sum: from chunk prefixes to the prefixes of all values.

use super::{SCAN_CHUNK, ScanParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// `(values, chunk_prefixes, prefixes)`: the last is written.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    constants: [(&str, f64); 2],
    count: u32,
    (values, chunk_prefixes, prefixes): (&GpuBuffer, &GpuBuffer, &GpuBuffer),
) {
    frame
        .pass(&gpu.kernel("build/scan_spread.wgsl", &constants))
        .uniform("params", &ScanParams { count })
        .bind("values", values)
        .bind("chunk_prefixes", chunk_prefixes)
        .bind("prefixes", prefixes)
        .bytes_moved(8 * u64::from(count))
        .dispatch(u64::from(count.div_ceil(SCAN_CHUNK).max(1)));
}
