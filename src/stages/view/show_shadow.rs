//! Shows a light's shadow map: distances in the colours of a scale.

use bytemuck::{Pod, Zeroable};

use super::Palette;
use crate::gpu::{Gpu, Mirror, Recorder, mirror};
use crate::stages::light::shadow::ShadowMap;
use crate::stages::pixels::{Picture, ViewParams};

/// Mirror of `ShowShadowParams` in shaders/view/show_shadow.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ShowShadowParams {
    pub least: f32,
    pub most: f32,
    pub layers: u32,
    pub map_px: u32,
}

pub const MIRRORS: &[Mirror] =
    &[mirror!(ShowShadowParams, "view/show_shadow.wgsl", "ShowShadowParams", least, most, layers, map_px)];

/// `range_cells`: distances of the scale's ends.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    map: &ShadowMap,
    range_cells: [f64; 2],
    (view, palette): (&ViewParams, &Palette),
    picture: &Picture,
) {
    let [least, most] = range_cells.map(|cells| cells as f32);
    let params = ShowShadowParams { least, most, layers: map.params.count, map_px: map.params.size_px };
    let pass = frame.pass(&gpu.kernel("view/show_shadow.wgsl", &[]));
    picture
        .bind(pass)
        .uniform("view", view)
        .uniform("palette", palette)
        .uniform("params", &params)
        .texture("shadow_map", &map.view)
        .dispatch(picture.tiled_threads());
}
