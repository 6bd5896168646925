//! What a screen shows of light: exposure, tone curve, sRGB bytes. As the view of surfaces has it.

use image::{Rgb, RgbImage, Rgba, RgbaImage};

use super::{LightPixel, light_of};
use crate::color::srgb_byte;
use crate::settings::{Look, SurfaceView, ToneCurve};
use crate::stages::pixels::MEAN_SHOWN_AS;
use crate::stages::surface::{count_luminance_ref, expose_ref};
use crate::stages::view::show_surfaces::tone_mapped;

/// Exposed further, every tone curve is at its end.
const MOST_EXPOSED: f64 = 1e6;

/// How light is shown. Pictures that are compared share it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// Multiplies light.
    pub exposure: f64,
    pub curve: ToneCurve,
}

impl Display {
    /// As settings want a part of the light shown; without an exposure of theirs, what the view chooses for `light`.
    pub fn new(look: &Look, part: SurfaceView, light: &[LightPixel]) -> Self {
        Self::exposed(look, part, || expose_ref::factor(expose_ref::bright(&count_luminance_ref::counts(light))))
    }

    /// The same to compare pictures in; without an exposure of theirs, the geometric mean of the truth is shown as
    /// [`MEAN_SHOWN_AS`], so that errors are those of most of the picture.
    pub fn of_mean(look: &Look, part: SurfaceView, truth: &[LightPixel]) -> Self {
        Self::exposed(look, part, || {
            let lit = truth.iter().filter(|pixel| pixel[3] > 0.0).map(light_of).filter(|nits| *nits > 0.0);
            let (sum, count) = lit.fold((0.0, 0.0), |(sum, count), nits| (sum + nits.log2(), count + 1.0));
            if count > 0.0 { MEAN_SHOWN_AS / f64::exp2(sum / count) } else { 1.0 }
        })
    }

    fn exposed(look: &Look, part: SurfaceView, automatic: impl FnOnce() -> f64) -> Self {
        if !part.is_light() {
            return Self { exposure: 1.0, curve: ToneCurve::Linear };
        }
        Self { exposure: look.exposure_stops.map_or_else(automatic, f64::exp2), curve: look.tone_curve }
    }

    /// Pixels beyond the end of `light` are black.
    pub fn picture(&self, light: &[LightPixel], [width, height]: [u32; 2]) -> RgbImage {
        RgbImage::from_fn(width, height, |x, y| {
            let pixel = light.get(y as usize * width as usize + x as usize);
            Rgb(pixel.map_or([0; 3], |pixel| self.bytes(pixel)))
        })
    }

    /// The same with the share of each pixel that shows something as its alpha, which colours are not multiplied by.
    pub fn cut_out(&self, light: &[LightPixel], [width, height]: [u32; 2]) -> RgbaImage {
        RgbaImage::from_fn(width, height, |x, y| {
            let pixel = light.get(y as usize * width as usize + x as usize).copied().unwrap_or_default();
            let [r, g, b, share] = pixel;
            if share <= 0.0 {
                return Rgba([0; 4]);
            }
            let [red, green, blue] = self.bytes(&[r / share, g / share, b / share, 1.0]);
            Rgba([red, green, blue, (share.min(1.0) * 255.0).round() as u8])
        })
    }

    /// sRGB.
    pub fn bytes(&self, &[r, g, b, _]: &LightPixel) -> [u8; 3] {
        [r, g, b].map(|channel| {
            let exposed = (f64::from(channel) * self.exposure).clamp(0.0, MOST_EXPOSED);
            srgb_byte(tone_mapped(self.curve, exposed) as f32)
        })
    }
}
