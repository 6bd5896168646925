//! Adds one light to the direct light of what the camera sees: BRDF times irradiance, hidden by the light's
//! shadow map.
//!
//! A shadow ray starts above the triangle by what the map's texels rise beside the point: at most √2 texels,
//! for light that grazes, and [`super::SHADOW_OFFSET_CELLS`].

use super::Lit;
use crate::gpu::{Gpu, Recorder};
use crate::stages::light::illuminate::LightParams;
use crate::stages::light::shadow::ShadowMap;

/// A `map` without layers hides nothing.
pub fn record(gpu: &Gpu, frame: &mut Recorder, lit: &Lit<'_>, light: &LightParams, map: &ShadowMap) {
    let pass = frame.pass(&gpu.kernel("surface/direct.wgsl", &[]));
    lit.bind(pass)
        .uniform("light", light)
        .uniform("shadow", &map.params)
        .texture("shadow_map", &map.view)
        .bytes_moved(lit.bytes(2))
        .dispatch(lit.tiled_threads());
}
