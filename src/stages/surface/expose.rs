//! The exposure of a picture of surfaces, measured without the CPU: a percentile of what is lit, so that neither
//! what lies in the dark nor a lamp decides.

use bytemuck::{Pod, Zeroable};

use super::count_luminance::COUNT_BYTES;
use crate::gpu::{Constant, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};

/// Of so many lit pixels, one is brighter than what is shown as [`BRIGHT_SHOWN_AS`].
pub const LIT_TO_BRIGHTER: u32 = 20;
/// Before the tone curve; 1 is white.
pub const BRIGHT_SHOWN_AS: f64 = 0.8;

pub const CONSTANTS: &[Constant] = constants![
    integer LIT_TO_BRIGHTER,
    float BRIGHT_SHOWN_AS,
];

/// Mirror of `PictureExposure` in shaders/shared/picture_exposure.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct PictureExposure {
    pub factor: f32,
    /// What it was measured from; 0 where nothing shines.
    pub bright: f32,
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(PictureExposure, "shared/picture_exposure.wgsl", "PictureExposure", factor, bright, pad)];

/// Of a buffer of it, which is made with the usage of a uniform.
pub const EXPOSURE_BYTES: u64 = size_of::<PictureExposure>() as u64;

impl PictureExposure {
    /// Not measured.
    pub fn set(factor: f64) -> Self {
        Self { factor: factor as f32, ..Self::default() }
    }
}

/// Writes `exposure`, one [`PictureExposure`], from what [`super::count_luminance`] counted.
pub fn record(gpu: &Gpu, frame: &mut Recorder, counts: &GpuBuffer, exposure: &GpuBuffer) {
    let kernel = gpu.kernel("surface/expose.wgsl", &[]);
    let threads = kernel.workgroup_size[0].into();
    frame
        .pass(&kernel)
        .bind("counts", counts)
        .bind("exposure", exposure)
        .bytes_moved(COUNT_BYTES + EXPOSURE_BYTES)
        .dispatch(threads);
}
