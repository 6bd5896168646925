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

use super::pixels::picture::tiled_threads;
pub use super::pixels::picture::{TILE_PX, tile_count};
use super::sample::SampledOctree;
use super::surface::RADIANCE_BYTES;
pub use super::surface::Surfaces;
use crate::gpu::{Constant, constants};

/// A filter's weights below this are none.
pub const LEAST_WEIGHT: f64 = 1e-4;

pub const CONSTANTS: &[Constant] = constants![
    float LEAST_WEIGHT,
];

/// What cones start at and what they go through.
#[derive(Clone, Copy, Debug)]
pub struct ConesInput<'a> {
    pub octree: &'a SampledOctree,
    pub surfaces: Surfaces<'a>,
}

/// Bytes of an image of that size.
pub fn image_bytes(size_px: [u32; 2]) -> u64 {
    RADIANCE_BYTES * pixels(size_px)
}

fn pixels(size_px: [u32; 2]) -> u64 {
    u64::from(size_px[0]) * u64::from(size_px[1])
}
