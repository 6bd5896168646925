//! A map of where one picture is brighter (red) or darker (blue) than the truth.

use image::{Rgba, RgbaImage};

use super::{LightPixel, light_of};

/// The truth's mean luminance: a difference of as much is at the end of the scale.
pub fn difference_scale(truth: &[LightPixel]) -> f64 {
    let mean = truth.iter().map(light_of).sum::<f64>() / truth.len().max(1) as f64;
    if mean > 0.0 { mean } else { 1.0 }
}

/// Signed difference of luminance over `scale`, in the colours of [`difference_color`].
pub fn difference_map(found: &[LightPixel], truth: &[LightPixel], size_px: [u32; 2], scale: f64) -> RgbaImage {
    let [width, height] = size_px;
    RgbaImage::from_fn(width, height, |x, y| {
        let index = y as usize * width as usize + x as usize;
        let light = |picture: &[LightPixel]| picture.get(index).map_or(0.0, light_of);
        let [r, g, b] = difference_color((light(found) - light(truth)) / scale);
        Rgba([r, g, b, u8::MAX])
    })
}

/// sRGB of a difference from −1 (dark blue) by 0 (white) to 1 (dark red).
pub fn difference_color(difference: f64) -> [u8; 3] {
    let colorous::Color { r, g, b } = colorous::RED_BLUE.eval_continuous((0.5 - 0.5 * difference).clamp(0.0, 1.0));
    [r, g, b]
}
