//! What the camera sees, the light that reaches it straight from the lights, and what is shown of all light
//! (section 4.5).
//!
//! ```text
//! posed triangles ─► draw (surface image) ─► emission ─► direct or direct_march (a light each) ─► compose ─► count_luminance
//!                          └─► cones: diffuse, specular ────────────────────────────────────────▲   └─► view::show_surfaces ◄── expose ◄──────────┘
//! ```
//!
//! Radiance is kept in a buffer of four floats a pixel, rows from the top: linear RGB in nits, and 1 where
//! the camera sees something, else 0.

pub mod brdf_ref;
pub mod compose;
pub mod compose_ref;
pub mod count_luminance;
pub mod count_luminance_ref;
pub mod direct;
pub mod direct_march;
pub mod direct_march_ref;
pub mod direct_ref;
pub mod draw;
pub mod emission;
pub mod emission_ref;
pub mod expose;
pub mod expose_ref;

use crate::data::surface_image::SurfaceImage;
use crate::gpu::{Constant, GpuBuffer, Kernel, PassBuilder, constants};
use crate::stages::pixels::ViewParams;
use crate::stages::pixels::picture::tiled_threads;

/// Reflectance at normal incidence of what is no metal (glTF 2.0, appendix B.3.3).
pub const DIELECTRIC_REFLECTANCE: f64 = 0.04;
/// Smoother surfaces count as this smooth: a point light's highlight on them would be smaller than any pixel.
pub const LEAST_ROUGHNESS: f64 = 0.045;
/// Cosine of a shading normal to the eye, which sees the surface after all.
pub const LEAST_EYE_COSINE: f64 = 0.01;
/// Of a shadow map, nothing lower above a surface hides it: half a texel, so that the facets of a
/// hollow do not shade one another along their edges, and what f32 distances of 1024 cells are off by.
pub const SHADOW_HEIGHT_TEXELS: f64 = 0.5;
pub const SHADOW_HEIGHT_CELLS: f64 = 1.0 / 512.0;

pub const CONSTANTS: &[Constant] = constants![
    float DIELECTRIC_REFLECTANCE,
    float LEAST_EYE_COSINE,
    float LEAST_ROUGHNESS,
    float SHADOW_HEIGHT_CELLS,
    float SHADOW_HEIGHT_TEXELS,
];

/// What the camera sees, and the view that it was seen in, of the same size.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    pub image: &'a SurfaceImage,
    pub view: &'a ViewParams,
}

impl Surfaces<'_> {
    /// All that shared/surface.wgsl declares.
    pub(super) fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        pass.uniform("view", self.view)
            .texture("surface_near", self.image.near.view())
            .texture("surface_stuff", self.image.stuff.view())
    }
}

/// What the camera sees, and where the light that reaches it is summed.
#[derive(Clone, Copy, Debug)]
pub struct Lit<'a> {
    pub image: &'a SurfaceImage,
    /// Of the image's size.
    pub view: &'a ViewParams,
    /// Four floats a pixel.
    pub direct: &'a GpuBuffer,
}

impl Lit<'_> {
    fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        Surfaces { image: self.image, view: self.view }.bind(pass).bind("direct", self.direct)
    }

    fn tiled_threads(&self) -> u64 {
        tiled_threads(self.image.size_px())
    }

    /// Of the texels, and of a sum that is written `times` times.
    fn bytes(&self, times: u64) -> u64 {
        (SURFACE_BYTES + times * RADIANCE_BYTES) * self.image.size_px().map(u64::from).iter().product::<u64>()
    }
}

/// Of a pixel.
pub const RADIANCE_BYTES: u64 = 16;
const SURFACE_BYTES: u64 = 32;
