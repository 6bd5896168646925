//! Counts luminances of what is shown, for an exposure.

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};

pub const COUNT_THREADS: u32 = 4096;
/// Bits of an f32 that a bin leaves out: its exponent and four bits more tell bins apart.
pub const LUMINANCE_BIN_SHIFT: u32 = 19;
/// All that is positive and finite, each stop in sixteen.
pub const LUMINANCE_BINS: u32 = 1 << 12;

pub const CONSTANTS: &[Constant] = constants![
    integer COUNT_THREADS,
    integer LUMINANCE_BIN_SHIFT,
    integer LUMINANCE_BINS,
];

pub const COUNT_BYTES: u64 = 4 * LUMINANCE_BINS as u64;

/// Mirror of `CountParams` in shaders/surface/count_luminance.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct CountParams {
    pub pixels: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(CountParams, "surface/count_luminance.wgsl", "CountParams", pixels)];

/// Writes `counts`, [`COUNT_BYTES`] long: how many pixels are in each bin.
pub fn record(gpu: &Gpu, frame: &mut Recorder, pixels: u32, shown: &GpuBuffer, counts: &GpuBuffer) {
    frame.clear(counts);
    frame
        .pass(&gpu.kernel("surface/count_luminance.wgsl", &[]))
        .uniform("params", &CountParams { pixels })
        .bind("shown", shown)
        .bind("counts", counts)
        .bytes_moved(16 * u64::from(pixels))
        .dispatch(COUNT_THREADS.into());
}
