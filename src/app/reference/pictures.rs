//! A traced picture in the colours of the one beside it, and how the two differ. In: linear light of both. Out:
//! sRGB bytes.

use std::sync::Arc;

use image::{DynamicImage, Rgba, RgbaImage};

use super::tracing::Traced;
use crate::accuracy::picture_error::{Display, LightPixel, difference_map, difference_scale};
use crate::color::srgb_byte;
use crate::settings::SurfaceView;
use crate::stages::pixels::BACKGROUND;

/// A finished picture of the engine, as light.
pub struct ConePicture {
    pub part: SurfaceView,
    pub size_px: [u32; 2],
    /// Rows from the top.
    pub pixels: Vec<LightPixel>,
    pub shown: Display,
    /// The sky is seen beside surfaces.
    pub shows_sky: bool,
}

/// Which pictures are drawn.
#[derive(Clone)]
pub struct OfPicture {
    pub cones: Arc<ConePicture>,
    pub traced: Arc<Traced>,
}

impl OfPicture {
    /// What paths say of the part that is shown.
    pub fn paths(&self) -> &[LightPixel] {
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
    /// The difference of luminance with the last colour of the scale.
    pub most_difference: f64,
}

pub fn draw(of: &OfPicture) -> Pictures {
    let (cones, paths) = (&of.cones, of.paths());
    let mut picture = DynamicImage::from(cones.shown.picture(paths, cones.size_px)).into_rgba8();
    if !cones.shows_sky {
        let [r, g, b] = BACKGROUND.map(srgb_byte);
        let beside = picture.pixels_mut().zip(paths).filter(|(_, path)| path[3] == 0.0);
        beside.for_each(|(pixel, _)| *pixel = Rgba([r, g, b, u8::MAX]));
    }
    let most_difference = difference_scale(paths);
    let difference = difference_map(&cones.pixels, paths, cones.size_px, most_difference);
    Pictures { paths: picture, difference, most_difference }
}

#[cfg(test)]
mod tests {
    use super::super::tracing::TracedPart;
    use super::*;
    use crate::settings::ToneCurve;

    fn drawn(part: SurfaceView, exposure: f64, cone: f32, path: f32) -> Pictures {
        let pixels = vec![[cone, cone, cone, 1.0], [0.0; 4]];
        let shown = Display { exposure, curve: ToneCurve::Linear };
        let cones = ConePicture { part, size_px: [2, 1], pixels, shown, shows_sky: false };
        let image = vec![[path, path / 2.0, 0.0, 1.0], [0.0; 4]];
        let traced = Traced { samples: 1, secs: 0.0, parts: vec![TracedPart { part, image, relative_error: None }] };
        draw(&OfPicture { cones: Arc::new(cones), traced: Arc::new(traced) })
    }

    #[test]
    fn paths_are_exposed_as_cones_are() {
        let picture = drawn(SurfaceView::Final, 2.0, 0.5, 0.5).paths;
        assert_eq!(picture.get_pixel(0, 0).0, [255, srgb_byte(0.5), 0, 255]);
        assert_eq!(picture.get_pixel(1, 0).0[0], srgb_byte(BACKGROUND[0]), "nothing is there");
    }

    #[test]
    fn differences_are_signed() {
        let [brighter, darker] = [1.0, 0.0].map(|cone| drawn(SurfaceView::Ao, 1.0, cone, 0.5).difference);
        let [brighter, darker] = [brighter, darker].map(|picture| picture.get_pixel(0, 0).0);
        assert!(brighter[0] > brighter[2] && darker[2] > darker[0], "{brighter:?} {darker:?}");
    }
}
