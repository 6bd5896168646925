//! The exposure of a picture of surfaces, measured without the CPU.

use bytemuck::{Pod, Zeroable};

use super::sum_luminance::SUM_BYTES;
use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Mirror of `PictureExposure` in shaders/shared/picture_exposure.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct PictureExposure {
    pub factor: f32,
    /// What it was measured from; 0 where nothing shines.
    pub mean: f32,
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(PictureExposure, "shared/picture_exposure.wgsl", "PictureExposure", factor, mean, pad)];

/// Of a buffer of it, which is made with the usage of a uniform.
pub const EXPOSURE_BYTES: u64 = size_of::<PictureExposure>() as u64;

impl PictureExposure {
    /// Not measured.
    pub fn set(factor: f64) -> Self {
        Self { factor: factor as f32, ..Self::default() }
    }
}

/// Writes `exposure`, one [`PictureExposure`], from what [`super::sum_luminance`] summed.
pub fn record(gpu: &Gpu, frame: &mut Recorder, sums: &GpuBuffer, exposure: &GpuBuffer) {
    let kernel = gpu.kernel("surface/mean_luminance.wgsl", &[]);
    let threads = kernel.workgroup_size[0].into();
    frame
        .pass(&kernel)
        .bind("sums", sums)
        .bind("exposure", exposure)
        .bytes_moved(SUM_BYTES + EXPOSURE_BYTES)
        .dispatch(threads);
}
