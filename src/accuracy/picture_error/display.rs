//! What a screen shows of light: exposure, tone curve, sRGB bytes. As the view of surfaces has it.

use image::{Rgb, RgbImage};

use super::{LightPixel, light_of};
use crate::color::srgb_byte;
use crate::settings::{Look, SurfaceView, ToneCurve};
use crate::stages::pixels::MEAN_SHOWN_AS;
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
    /// As settings want a part of the light shown; without an exposure of theirs, what `light` asks for.
    pub fn new(look: &Look, part: SurfaceView, light: &[LightPixel]) -> Self {
        if !part.is_light() {
            return Self { exposure: 1.0, curve: ToneCurve::Linear };
        }
        let stops = light.iter().filter(|pixel| pixel[3] > 0.0).map(light_of).filter(|nits| *nits > 0.0).map(f64::log2);
        let (sum, count) = stops.fold((0.0, 0.0), |(sum, count), stops| (sum + stops, count + 1.0));
        let automatic = if count > 0.0 { MEAN_SHOWN_AS / f64::exp2(sum / count) } else { 1.0 };
        Self { exposure: look.exposure_stops.map_or(automatic, f64::exp2), curve: look.tone_curve }
    }

    /// Pixels beyond the end of `light` are black.
    pub fn picture(&self, light: &[LightPixel], [width, height]: [u32; 2]) -> RgbImage {
        RgbImage::from_fn(width, height, |x, y| {
            let pixel = light.get(y as usize * width as usize + x as usize);
            Rgb(pixel.map_or([0; 3], |pixel| self.bytes(pixel)))
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
