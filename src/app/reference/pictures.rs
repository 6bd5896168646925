//! A traced picture in the colours of the one beside it, and how the two differ. In: linear light of both. Out:
//! sRGB bytes.

use std::sync::Arc;

use colorous::Color;
use image::{Rgba, RgbaImage};
use rayon::prelude::*;

use super::tracing::Traced;
use crate::color::{luminance, srgb_byte};
use crate::settings::{SurfaceView, ToneCurve};
use crate::stages::view::BACKGROUND;
use crate::stages::view::show_surfaces::tone_mapped;

/// Of what white stands for: differences this large have the last colour of the scale.
const MOST_OF_WHITE: f64 = 0.25;

/// A finished picture of the engine, as light.
pub struct ConePicture {
    pub part: SurfaceView,
    pub size_px: [u32; 2],
    /// Rows from the top; the last channel is 1 where a surface is.
    pub pixels: Vec<[f32; 4]>,
    pub exposure: f64,
    pub curve: ToneCurve,
    pub has_sky: bool,
}

impl ConePicture {
    fn is_drawn(&self, pixel: &[f32; 4]) -> bool {
        pixel[3] > 0.0 || self.part.is_light() && self.has_sky
    }

    /// As the engine draws it.
    fn color(&self, value: [f32; 3]) -> Rgba<u8> {
        let shown = |channel: f32| match self.part.is_light() {
            true => tone_mapped(self.curve, self.exposure * f64::from(channel)) as f32,
            false => channel,
        };
        let [r, g, b] = value.map(|channel| srgb_byte(shown(channel)));
        Rgba([r, g, b, u8::MAX])
    }

    /// The difference that has the last colour of the scale, in the unit of the part.
    pub fn most_difference(&self) -> f64 {
        if self.part.is_light() { MOST_OF_WHITE / self.exposure } else { MOST_OF_WHITE }
    }
}

/// Which pictures are drawn.
#[derive(Clone)]
pub struct OfPicture {
    pub cones: Arc<ConePicture>,
    pub traced: Arc<Traced>,
}

impl OfPicture {
    /// What paths say of the part that is shown.
    pub fn paths(&self) -> &[[f32; 3]] {
        self.traced.part(self.cones.part).map_or(&[], |part| &part.image)
    }
}

impl PartialEq for OfPicture {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.cones, &other.cones) && Arc::ptr_eq(&self.traced, &other.traced)
    }
}

/// What paths say of the same picture.
pub struct Pictures {
    pub paths: RgbaImage,
    pub difference: RgbaImage,
}

pub fn draw(cones: &ConePicture, paths: &[[f32; 3]]) -> Pictures {
    let [r, g, b] = BACKGROUND.map(srgb_byte);
    let background = Rgba([r, g, b, u8::MAX]);
    let most = cones.most_difference();
    let both = || cones.pixels.par_iter().zip(paths);
    let traced = both().map(|(cone, path)| if cones.is_drawn(cone) { cones.color(*path) } else { background });
    let difference = both().map(|(cone, path)| {
        let light = |[r, g, b]: [f32; 3]| luminance([r, g, b].map(f64::from));
        let [r, g, b] = difference_color((light([cone[0], cone[1], cone[2]]) - light(*path)) / most);
        Rgba([r, g, b, u8::MAX])
    });
    Pictures { paths: picture(cones.size_px, traced), difference: picture(cones.size_px, difference) }
}

/// Black where there are no pixels.
fn picture([width, height]: [u32; 2], pixels: impl IndexedParallelIterator<Item = Rgba<u8>>) -> RgbaImage {
    let mut picture = RgbaImage::new(width, height);
    let pixels: Vec<Rgba<u8>> = pixels.collect();
    picture.pixels_mut().zip(pixels).for_each(|(pixel, value)| *pixel = value);
    picture
}

/// sRGB bytes: red where cones are brighter, blue where they are darker, white where they agree.
pub fn difference_color(part: f64) -> [u8; 3] {
    let Color { r, g, b } = colorous::RED_BLUE.eval_continuous(0.5 - 0.5 * part.clamp(-1.0, 1.0));
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cones(part: SurfaceView) -> ConePicture {
        let pixels = vec![[0.5, 0.5, 0.5, 1.0], [0.0; 4]];
        let size_px = [2, 1];
        ConePicture { part, size_px, pixels, exposure: 2.0, curve: ToneCurve::Linear, has_sky: false }
    }

    #[test]
    fn paths_are_exposed_and_toned_as_cones_are() {
        let drawn = draw(&cones(SurfaceView::Final), &[[0.5, 0.25, 0.0], [1.0; 3]]);
        assert_eq!(drawn.paths.get_pixel(0, 0).0, [255, srgb_byte(0.5), 0, 255]);
        assert_eq!(drawn.paths.get_pixel(1, 0).0[0], srgb_byte(BACKGROUND[0]), "nothing is there");
        let drawn = draw(&cones(SurfaceView::Ao), &[[0.5; 3], [1.0; 3]]);
        assert_eq!(drawn.paths.get_pixel(0, 0).0[0], srgb_byte(0.5), "a share has no exposure");
    }

    #[test]
    fn differences_are_signed_and_white_where_there_are_none() {
        let at = |path: f32| draw(&cones(SurfaceView::Final), &[[path; 3], [0.0; 3]]).difference.get_pixel(0, 0).0;
        let [same, brighter, darker] = [0.5, 0.4, 0.6].map(at);
        assert!(same[..3].iter().all(|byte| *byte > 235), "{same:?}");
        assert!(brighter[0] > brighter[2] && darker[2] > darker[0], "{brighter:?} {darker:?}");
        assert_eq!(at(1e9), at(2e9), "the scale ends");
    }
}
