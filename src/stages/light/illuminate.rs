//! Adds one light's irradiance to every occupied leaf, in the units of KHR_lights_punctual.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::shadow::ShadowMap;
use super::{LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT, LitOctree, SHADOWS_MAP, SHADOWS_MARCH, SHADOWS_OFF};
use crate::data::grid::Grid;
use crate::data::light::IRRADIANCE_BYTES;
use crate::data::octree::OctreeParams;
use crate::gpu::{Counted, Gpu, GpuBuffer, Mirror, Recorder, mirror};
use crate::lights::PosedLight;
use crate::scene::LightKind;
use crate::settings::lighting::Shadows;

/// The narrowest difference of a spot's cosines, as KHR_lights_punctual has it.
const LEAST_CONE: f64 = 0.001;

/// Mirror of `LightParams` in shaders/shared/light.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightParams {
    pub position: [f32; 3],
    pub kind: u32,
    pub direction: [f32; 3],
    pub range_cells: f32,
    pub strength: [f32; 3],
    pub offset_cells: f32,
    pub angle_scale: f32,
    pub angle_offset: f32,
    pub pad: [u32; 2],
}

pub const MIRRORS: &[Mirror] = &[mirror!(
    LightParams,
    "shared/light.wgsl",
    "LightParams",
    position,
    kind,
    direction,
    range_cells,
    strength,
    offset_cells,
    angle_scale,
    angle_offset,
    pad
)];

impl LightParams {
    pub fn new(light: &PosedLight, grid: &Grid, offset_cells: f64) -> Self {
        let square = grid.span * grid.span;
        let (kind, range, strength) = match light.kind {
            LightKind::Directional => (LIGHT_DIRECTIONAL, None, light.strength),
            LightKind::Point { range } => (LIGHT_POINT, range, light.strength / square),
            LightKind::Spot { range, .. } => (LIGHT_SPOT, range, light.strength / square),
        };
        let (angle_scale, angle_offset) = spot_angles(light.kind);
        let position = if kind == LIGHT_DIRECTIONAL {
            DVec3::ZERO
        } else {
            grid.grid_from_world().transform_point3(light.position)
        };
        Self {
            position: position.as_vec3().to_array(),
            kind,
            direction: light.direction.as_vec3().to_array(),
            range_cells: range.map_or(0.0, |range| (f64::from(range) / grid.span) as f32),
            strength: strength.as_vec3().to_array(),
            offset_cells: offset_cells as f32,
            angle_scale: angle_scale as f32,
            angle_offset: angle_offset as f32,
            pad: [0; 2],
        }
    }
}

/// Attenuation of a spot is (cosine · scale + offset)², clamped to 0 … 1 before.
fn spot_angles(kind: LightKind) -> (f64, f64) {
    let LightKind::Spot { inner_cone_radians, outer_cone_radians, .. } = kind else { return (0.0, 0.0) };
    let (inner, outer) = (f64::from(inner_cone_radians).cos(), f64::from(outer_cone_radians).cos());
    let scale = 1.0 / (inner - outer).max(LEAST_CONE);
    (scale, -outer * scale)
}

/// Adds to `irradiance`, which holds three floats an occupied leaf. `map` is read under [`Shadows::Map`]
/// alone.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &LitOctree,
    irradiance: &GpuBuffer,
    light: &LightParams,
    (shadows, map): (Shadows, &ShadowMap),
) {
    let how = match shadows {
        Shadows::Off => SHADOWS_OFF,
        Shadows::Map => SHADOWS_MAP,
        Shadows::March => SHADOWS_MARCH,
    };
    let pass = frame.pass(&gpu.kernel("light/illuminate.wgsl", &[("SHADOWS", f64::from(how))]));
    octree
        .bind_leaves(pass)
        .uniform("light", light)
        .uniform("shadow", &map.params)
        .texture("shadow_map", &map.view)
        .bind("block_keys", &octree.block_keys)
        .bind("irradiance", irradiance)
        .counted(&octree.sizes.buffer, |octree: &OctreeParams| {
            let threads = u64::from(octree.leaf_block_count);
            Counted { threads, bytes: threads * (4 + 8) + u64::from(octree.leaf_count) * (4 + 2 * IRRADIANCE_BYTES) }
        })
        .dispatch(octree.sizes.params.leaf_block_count.into());
}
