//! How far cones are from paths, part by part. In: linear light of both. Out: errors, as `accuracy --rendering`
//! has them.

use std::sync::Arc;

use super::tracing::{PARTS, Traced};
use crate::accuracy::picture_error::PictureError;
use crate::settings::{SurfaceView, ToneCurve};

/// The parts of a finished picture of the engine that were read so far.
#[derive(Default)]
pub struct ConeParts {
    pub size_px: [u32; 2],
    pub exposure: f64,
    pub curve: ToneCurve,
    /// In the order of [`PARTS`]; `None`: the engine has not made it.
    pub pixels: Vec<Option<Vec<[f32; 3]>>>,
}

impl ConeParts {
    /// What is to be read next.
    pub fn missing(&self) -> Option<SurfaceView> {
        PARTS.get(self.pixels.len()).copied()
    }
}

/// Errors of the parts that both have.
pub struct Measured {
    pub parts: Vec<MeasuredPart>,
}

pub struct MeasuredPart {
    pub part: SurfaceView,
    pub error: PictureError,
}

pub fn measure(cones: &ConeParts, traced: &Traced) -> Measured {
    let measured = PARTS.into_iter().zip(&cones.pixels).filter_map(|(part, pixels)| {
        // Shares have no exposure.
        let (exposure, curve) = if part.is_light() { (cones.exposure, cones.curve) } else { (1.0, ToneCurve::Linear) };
        let paths = &traced.part(part)?.image;
        let error = PictureError::of(pixels.as_ref()?, paths, cones.size_px, exposure, curve);
        Some(MeasuredPart { part, error })
    });
    Measured { parts: measured.collect() }
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
