//! Light that reaches the surfaces that the camera sees, by cones through the lit octree (section 4.5).
//!
//! ```text
//! surface image ─► diffuse ──────────────────────────────► blur (rows, columns) ─► upsample
//!                  glossy_tiles ─► list_tiles ─► specular ───────────────────────► upsample
//! ```
//!
//! Images are arrays of vec4 f32, rows from the top. `diffuse`: mean radiance over the cosine-weighted
//! hemisphere (nits; irradiance is π times that), and the open share. `specular`: radiance along the mirror
//! direction, and 1 where there is one. All are made again from the surface image alone.

pub mod blur;
pub mod blur_ref;
pub mod diffuse;
pub mod diffuse_ref;
pub mod filter;
pub mod glossy_tiles;
pub mod glossy_tiles_ref;
pub mod list_tiles;
pub mod list_tiles_ref;
pub mod specular;
pub mod specular_ref;
pub mod upsample;
pub mod upsample_ref;

use super::sample::SampledOctree;
use super::surface::RADIANCE_BYTES;
use super::view::ViewParams;
use crate::data::surface_image::SurfaceImage;
use crate::gpu::{Kernel, PassBuilder};

/// Sides of the tiles in which threads walk an image, and in which specular cones are decided.
pub const TILE_PX: u32 = 8;
/// A filter's weights below this are none.
pub const LEAST_WEIGHT: f64 = 1e-4;

/// The surfaces that are lit, and the view that they were seen in, of the same size.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    pub image: &'a SurfaceImage,
    pub view: &'a ViewParams,
}

/// What cones start at and what they go through.
#[derive(Clone, Copy, Debug)]
pub struct ConesInput<'a> {
    pub octree: &'a SampledOctree,
    pub surfaces: Surfaces<'a>,
}

impl Surfaces<'_> {
    fn bind<'a>(&self, pass: PassBuilder<'a, Kernel>) -> PassBuilder<'a, Kernel> {
        pass.uniform("view", self.view)
            .texture("surface_near", self.image.near.view())
            .texture("surface_stuff", self.image.stuff.view())
    }
}

/// Bytes of an image of that size.
pub fn image_bytes(size_px: [u32; 2]) -> u64 {
    RADIANCE_BYTES * pixels(size_px)
}

fn pixels(size_px: [u32; 2]) -> u64 {
    u64::from(size_px[0]) * u64::from(size_px[1])
}

/// Tiles that cover an image.
pub fn tile_count(size_px: [u32; 2]) -> u32 {
    size_px[0].div_ceil(TILE_PX) * size_px[1].div_ceil(TILE_PX)
}

/// Threads that walk an image in tiles.
fn tiled_threads(size_px: [u32; 2]) -> u64 {
    u64::from(TILE_PX * TILE_PX) * u64::from(tile_count(size_px))
}
