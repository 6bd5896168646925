//! How far one picture of light is from another, which is taken as the truth.
//!
//! In: four f32 a pixel, rows from the top: linear RGB and 1 where a surface is (as the engine reads and
//! the path tracer gives them), and how both are shown. Out: relMSE and bias of the light itself, SSIM and
//! FLIP of what a screen shows of it, and a map of the signed difference.

mod difference;
mod display;

use image::RgbImage;
use serde::Serialize;

use crate::color::luminance;

pub use difference::{difference_color, difference_map, difference_scale};
pub use display::Display;

/// Linear RGB, and 1 where a surface is.
pub type LightPixel = [f32; 4];

/// relMSE divides by the squared truth, and by the square of this share of its mean: so black counts too.
const DARK_SHARE: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PictureError {
    /// Mean of (x − r)² / (r² + (r̄/10)²) over the channels of pixels where the truth r has a surface.
    pub rel_mse: f64,
    /// Mean luminance over that of the truth, less 1, of the same pixels: positive where too bright.
    pub bias: f64,
    /// Of what is shown: structural similarity, 1 where alike; the worst channel.
    pub ssim: f64,
    /// Of what is shown: what an eye sees of the difference at 67 pixels a degree, 0 to 1 (Andersson et al.
    /// 2020). `None` where the program is built without the feature `flip`.
    pub flip: Option<f64>,
}

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompareError {
    #[error("pictures of {found} and {truth} pixels cannot be compared at {} x {} pixels", size_px[0], size_px[1])]
    Sizes { found: usize, truth: usize, size_px: [u32; 2] },
    #[error("SSIM cannot be computed: {0}")]
    Ssim(String),
}

/// Both are rows of a picture of `size_px`.
pub fn compare(
    found: &[LightPixel],
    truth: &[LightPixel],
    size_px: [u32; 2],
    shown: &Display,
) -> Result<PictureError, CompareError> {
    let pixels = size_px[0] as usize * size_px[1] as usize;
    if found.len() != pixels || truth.len() != pixels {
        return Err(CompareError::Sizes { found: found.len(), truth: truth.len(), size_px });
    }
    let [found_shown, truth_shown] = [found, truth].map(|light| shown.picture(light, size_px));
    let mean = |light: &dyn Fn(&(&LightPixel, &LightPixel)) -> f64| {
        let seen = found.iter().zip(truth).filter(|(_, truth)| truth[3] > 0.0);
        let (sum, count) = seen.fold((0.0, 0.0), |(sum, count), pair| (sum + light(&pair), count + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    };
    let (found_mean, truth_mean) = (mean(&|(found, _)| light_of(found)), mean(&|(_, truth)| light_of(truth)));
    let dark = (DARK_SHARE * truth_mean).powi(2).max(f64::MIN_POSITIVE);
    let rel_mse = mean(&|(found, truth)| relative_square(found, truth, dark));
    let bias = if truth_mean > 0.0 { found_mean / truth_mean - 1.0 } else { 0.0 };
    let ssim = ssim(&found_shown, &truth_shown)?;
    Ok(PictureError { rel_mse, bias, ssim, flip: flip(&found_shown, &truth_shown) })
}

/// Luminance.
fn light_of(&[r, g, b, _]: &LightPixel) -> f64 {
    luminance([r, g, b].map(f64::from))
}

fn relative_square(found: &LightPixel, truth: &LightPixel, dark: f64) -> f64 {
    let channel = |c: usize| {
        let (x, r) = (f64::from(found[c]), f64::from(truth[c]));
        (x - r).powi(2) / (r * r + dark)
    };
    (0..3).map(channel).sum::<f64>() / 3.0
}

fn ssim(found: &RgbImage, truth: &RgbImage) -> Result<f64, CompareError> {
    let similarity = image_compare::rgb_similarity_structure(&image_compare::Algorithm::MSSIMSimple, truth, found);
    Ok(similarity.map_err(|error| CompareError::Ssim(error.to_string()))?.score)
}

#[cfg(feature = "flip")]
fn flip(found: &RgbImage, truth: &RgbImage) -> Option<f64> {
    let [truth, found] =
        [truth, found].map(|picture| nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), picture));
    let map = nv_flip::flip(truth, found, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    Some(f64::from(nv_flip::FlipPool::from_image(&map).mean()))
}

#[cfg(not(feature = "flip"))]
fn flip(_found: &RgbImage, _truth: &RgbImage) -> Option<f64> {
    None
}
