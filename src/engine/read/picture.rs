//! The picture on screen, and what its colours stand for.

use super::super::{Engine, EngineError, PassTiming};
use super::missing;
use crate::color::srgb_byte;
use crate::gpu::GpuTexture;
use crate::stages::pixels::{BACKGROUND, NO_DEPTH};

impl Engine {
    /// The picture, gamma-encoded sRGB; `None` before the first, and where nothing is to be seen.
    pub fn image(&self) -> Option<&GpuTexture> {
        let on_screen = self.on_screen.as_ref().filter(|_| !self.shows_nothing());
        on_screen.map(|on_screen| &on_screen.picture.color)
    }

    /// The picture's pixels, all background where nothing is to be seen. Blocks until they are here.
    pub fn read_image(&self) -> Result<image::RgbaImage, EngineError> {
        if let Some(wanted) = self.wanted.as_ref().filter(|wanted| wanted.shows_nothing()) {
            let [width, height] = wanted.shot.size_px;
            return Ok(image::RgbaImage::from_pixel(width, height, background_pixel()));
        }
        let on_screen = self.on_screen.as_ref().ok_or_else(|| missing("picture"))?;
        Ok(on_screen.picture.read(&self.gpu)?)
    }

    /// The same, transparent where nothing is.
    pub fn read_cut_out(&self) -> Result<image::RgbaImage, EngineError> {
        let mut image = self.read_image()?;
        let is_empty = self.wanted.as_ref().is_some_and(|wanted| wanted.shows_nothing());
        let distances = match &self.on_screen {
            Some(on_screen) if !is_empty => on_screen.picture.read_distances(&self.gpu)?,
            _ => Vec::new(),
        };
        for (index, pixel) in image.pixels_mut().enumerate() {
            if distances.get(index).is_none_or(|distance| *distance == NO_DEPTH) {
                *pixel = image::Rgba([0; 4]);
            }
        }
        Ok(image)
    }

    /// What light is multiplied by before it is shown; 1 where there is none.
    pub fn exposure(&self) -> f64 {
        self.shown.as_ref().map_or(1.0, |shown| shown.results.exposure)
    }

    /// Ends of the colour scale of a slice (nits, lux or 1), a shadow map or depths (scene units); `None` where
    /// another view is shown.
    pub fn value_range(&self) -> Option<[f64; 2]> {
        self.shown.as_ref()?.results.value_range
    }

    /// Tiles of the last picture of surfaces whose pixels sent out a specular cone.
    pub fn glossy_tiles(&self) -> u32 {
        self.shown.as_ref().map_or(0, |shown| shown.results.glossy_tiles)
    }

    /// Kernel times of what is shown, each from the frame that made it, in flow order.
    pub fn timings(&self) -> &[PassTiming] {
        self.shown.as_ref().map_or(&[], |shown| &shown.results.timings)
    }
}

fn background_pixel() -> image::Rgba<u8> {
    let [r, g, b] = BACKGROUND.map(srgb_byte);
    image::Rgba([r, g, b, u8::MAX])
}
