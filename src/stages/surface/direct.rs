//! Adds one light to the direct light of what the camera sees: BRDF times irradiance, hidden by the light's
//! shadow map.
//!
//! A texel of the map hides a surface if what it sees lies above the surface's plane, by more than
//! [`super::SHADOW_HEIGHT_TEXELS`] and [`super::SHADOW_HEIGHT_CELLS`]: no offset moves the shadow's edge.

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
