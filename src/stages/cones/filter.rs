//! The filter behind traced images: spreads the parts of a pattern over its pixels, and brings an image to the
//! size of the surfaces.

use super::Surfaces;
use super::blur::{self, Along, BlurParams};
use super::upsample::{self, Pixels};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// An image as traced, which the filter overwrites, and what it is.
#[derive(Clone, Copy, Debug)]
pub struct Traced<'a> {
    pub image: &'a GpuBuffer,
    pub size_px: [u32; 2],
    /// Side of the squares of pixels that share a set of directions.
    pub pattern_px: u32,
    pub pixels: Pixels,
}

/// Whether an image goes through no filter at all: it is what is shown.
pub fn is_done(surfaces_px: [u32; 2], size_px: [u32; 2], pattern_px: u32) -> bool {
    pattern_px == 1 && size_px == surfaces_px
}

/// From `traced` to `filtered`, which is as large as the surface image. `scratch`, as large as the traced
/// image, is needed where there is a pattern. Neither may be the traced image; records nothing where
/// [`is_done`].
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    surfaces: &Surfaces<'_>,
    traced: &Traced<'_>,
    (scratch, filtered): (&GpuBuffer, &GpuBuffer),
) {
    let Traced { image, size_px, pattern_px, pixels } = *traced;
    let is_small = size_px != surfaces.image.size_px();
    if pattern_px > 1 {
        let params = |along| BlurParams::new(size_px, pattern_px, along);
        let blurred = if is_small { image } else { filtered };
        blur::record(gpu, frame, surfaces, &params(Along::Rows), (image, scratch));
        blur::record(gpu, frame, surfaces, &params(Along::Columns), (scratch, blurred));
    }
    if is_small {
        upsample::record(gpu, frame, surfaces, (size_px, pixels), (image, filtered));
    }
}
