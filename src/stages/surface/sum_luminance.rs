//! The mean luminance of what is shown, for an exposure: logarithms, so that a lamp does not decide alone.

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};

/// Each writes a sum and a count, which `mean_luminance` adds up.
pub const SUM_THREADS: u32 = 1024;

pub const CONSTANTS: &[Constant] = constants![
    integer SUM_THREADS,
];

pub const SUM_BYTES: u64 = 8 * SUM_THREADS as u64;

/// Mirror of `SumParams` in shaders/surface/sum_luminance.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SumParams {
    pub pixels: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(SumParams, "surface/sum_luminance.wgsl", "SumParams", pixels)];

/// Writes `sums`, [`SUM_BYTES`] long.
pub fn record(gpu: &Gpu, frame: &mut Recorder, pixels: u32, shown: &GpuBuffer, sums: &GpuBuffer) {
    frame
        .pass(&gpu.kernel("surface/sum_luminance.wgsl", &[]))
        .uniform("params", &SumParams { pixels })
        .bind("shown", shown)
        .bind("sums", sums)
        .bytes_moved(16 * u64::from(pixels))
        .dispatch(SUM_THREADS.into());
}
