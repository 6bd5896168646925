//! Reference of `compose.wgsl`: radiance towards the eye as a sum of three terms.
//!
//! ```text
//! direct    emission + Σ lights BRDF · E
//! diffuse   c_diff (1 − ρ) L̄              ρ = directional albedo of the specular lobe, ∫ F D V n·l dω
//! specular  ρ L, L = mean radiance in the specular cone; L̄ where a surface is not glossy
//! L̄         mean radiance over the cosine-weighted hemisphere: irradiance / π
//! ```

use glam::DVec3;

use super::brdf_ref::{self, Reflector};
use crate::data::surface_image::SurfaceTexel;
use crate::settings::SurfaceView;

/// Half vectors along each axis that the specular lobe is integrated by.
const STEPS: u32 = 64;

/// What reaches the eye by way of a pixel's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    pub direct: DVec3,
    /// L̄, nits.
    pub mean: DVec3,
    pub open_share: f64,
    /// Of the specular cone, nits.
    pub specular: DVec3,
}

/// What a view shows of a surface that `to_eye` (unit length) leaves.
pub fn shown(
    shown_as: SurfaceView,
    (texel, to_eye): (&SurfaceTexel, DVec3),
    light: &Light,
    (glossy_roughness, span): (f64, f64),
) -> DVec3 {
    let reflector =
        Reflector { albedo: DVec3::from_array(texel.albedo), roughness: texel.roughness, metallic: texel.metallic };
    let reflectance = reflectance(&reflector, texel.normal.dot(to_eye));
    let diffuse = reflector.albedo * (1.0 - reflector.metallic) * (1.0 - reflectance) * light.mean;
    let specular = reflectance * if texel.roughness > glossy_roughness { light.mean } else { light.specular };
    match shown_as {
        SurfaceView::Final => light.direct + diffuse + specular,
        SurfaceView::Direct => light.direct,
        SurfaceView::Diffuse => diffuse,
        SurfaceView::Specular => specular,
        SurfaceView::Ao => DVec3::splat(light.open_share),
        SurfaceView::Irradiance => std::f64::consts::PI * light.mean,
        SurfaceView::Albedo => reflector.albedo,
        SurfaceView::Normal => texel.normal,
        SurfaceView::Depth => DVec3::splat(f64::from(texel.distance_cells) * span),
        SurfaceView::Roughness => DVec3::splat(texel.roughness),
    }
}

fn reflectance(reflector: &Reflector, cosine: f64) -> DVec3 {
    let (scale, bias) = brdf_ref::specular_albedo(reflector.roughness, cosine.max(0.0), STEPS);
    reflector.f0() * scale + bias
}
