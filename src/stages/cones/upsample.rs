//! From a small image to the size of the surfaces, stopping at their edges.

use bytemuck::{Pod, Zeroable};

use super::{Surfaces, image_bytes, tiled_threads};
use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Mirror of `UpsampleParams` in shaders/cones/upsample.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct UpsampleParams {
    pub size_px: [u32; 2],
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] = &[mirror!(UpsampleParams, "cones/upsample.wgsl", "UpsampleParams", size_px, pad)];

/// What the last channel of an image says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pixels {
    /// All hold something.
    All,
    /// Those do whose last channel is not 0.
    Marked,
}

/// From `image` of `size_px` to `large`, as large as the surface image.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    surfaces: &Surfaces<'_>,
    (size_px, pixels): ([u32; 2], Pixels),
    (image, large): (&GpuBuffer, &GpuBuffer),
) {
    let sparse = f64::from(u8::from(pixels == Pixels::Marked));
    let to_px = surfaces.image.size_px();
    let pass = frame.pass(&gpu.kernel("cones/upsample.wgsl", &[("SPARSE", sparse)]));
    surfaces
        .bind(pass)
        .uniform("params", &UpsampleParams { size_px, pad: [0; 2] })
        .bind("image", image)
        .bind("large", large)
        .bytes_moved(image_bytes(size_px) + 3 * image_bytes(to_px))
        .dispatch(tiled_threads(to_px));
}
