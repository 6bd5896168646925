//! How far cones are from paths, part by part. In: linear light of both. Out: errors, as `accuracy --rendering`
//! has them.

use std::sync::Arc;

use super::tracing::{PARTS, Traced};
use crate::accuracy::picture_error::{CompareError, Display, LightPixel, PictureError, compare};
use crate::settings::{Look, SurfaceView};

/// The parts of a finished picture of the engine that were read so far.
#[derive(Default)]
pub struct ConeParts {
    pub size_px: [u32; 2],
    /// How it is shown.
    pub look: Look,
    /// In the order of [`PARTS`]; `None`: the engine has not made it.
    pub pixels: Vec<Option<Vec<LightPixel>>>,
}

impl ConeParts {
    /// What is to be read next.
    pub fn missing(&self) -> Option<SurfaceView> {
        PARTS.get(self.pixels.len()).copied()
    }
}

/// Errors of a part that both have.
pub struct MeasuredPart {
    pub part: SurfaceView,
    pub error: PictureError,
}

/// Each part is shown as its paths ask for.
pub fn measure(cones: &ConeParts, traced: &Traced) -> Result<Vec<MeasuredPart>, CompareError> {
    let both = PARTS.into_iter().zip(&cones.pixels).filter_map(|(part, pixels)| {
        let (pixels, paths) = (pixels.as_ref()?, &traced.part(part)?.image);
        let error = compare(pixels, paths, cones.size_px, &Display::of_mean(&cones.look, part, paths));
        Some(error.map(|error| MeasuredPart { part, error }))
    });
    both.collect()
}

/// What errors are of.
#[derive(Clone)]
pub struct OfParts {
    pub cones: Arc<ConeParts>,
    pub traced: Arc<Traced>,
}

impl PartialEq for OfParts {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.cones, &other.cones) && Arc::ptr_eq(&self.traced, &other.traced)
    }
}
