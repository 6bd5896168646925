//! Gathers irradiance at the leaves by cones: what the sky sends, and further bounces.

use bytemuck::{Pod, Zeroable};

use super::LitOctree;
use crate::data::octree::OctreeParams;
use crate::gpu::{Constant, Counted, Gpu, GpuBuffer, Mirror, Recorder, constants, mirror};
use crate::settings::lighting::Opacity;

/// A step is never shorter than this, in cells: what bounds the steps of a cone.
pub const LEAST_STEP: f64 = 1.0 / 16.0;
/// Between neighbouring directions of a sunflower: a turn divided by the golden ratio, twice, in 2^-32 of a turn.
pub const GOLDEN_TURN: u32 = 0x61c8_8647;
/// One of those units, in radians.
pub const TURN_ANGLE: f64 = std::f64::consts::TAU / (1_u64 << 32) as f64;

pub const CONSTANTS: &[Constant] = constants![
    integer GOLDEN_TURN,
    float LEAST_STEP,
    float TURN_ANGLE,
];

/// How a surface looks around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cones {
    /// Over a hemisphere, at least 1.
    pub count: u32,
    /// Full apex angle, 0 to 180 degrees.
    pub aperture_degrees: f64,
    /// From a leaf's centre to the apex along its normal, in voxels.
    pub start_cells: f64,
    /// Length of a step in diameters, [`LEAST_STEP`] at least.
    pub step_diameters: f64,
    /// Where a cone ends at the latest; infinite: at the grid's edge.
    pub reach_cells: f64,
}

impl Default for Cones {
    fn default() -> Self {
        Self { count: 8, aperture_degrees: 60.0, start_cells: 1.5, step_diameters: 1.0, reach_cells: f64::INFINITY }
    }
}

impl Cones {
    /// 2·tan(a/2): growth of the diameter with distance.
    pub fn widening(&self) -> f64 {
        2.0 * (self.aperture_degrees.to_radians() / 2.0).tan()
    }
}

/// Mirror of `ConeShape` in shaders/shared/cone.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ConeShape {
    pub widening: f32,
    pub start_cells: f32,
    pub step_diameters: f32,
    pub reach_cells: f32,
}

impl ConeShape {
    pub fn new(cones: &Cones) -> Self {
        Self {
            widening: cones.widening() as f32,
            start_cells: cones.start_cells as f32,
            step_diameters: cones.step_diameters as f32,
            // Shaders know no infinity.
            reach_cells: cones.reach_cells.min(f64::from(f32::MAX)) as f32,
        }
    }
}

/// Mirror of `ConeParams` in shaders/light/gather.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ConeParams {
    pub sky: [f32; 3],
    pub count: u32,
    pub shape: ConeShape,
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(ConeShape, "shared/cone.wgsl", "ConeShape", widening, start_cells, step_diameters, reach_cells),
    mirror!(ConeParams, "light/gather.wgsl", "ConeParams", sky, count, shape),
];

impl ConeParams {
    /// `sky`: radiance from all directions, nits.
    pub fn new(cones: &Cones, sky: [f32; 3]) -> Self {
        Self { sky, count: cones.count, shape: ConeShape::new(cones) }
    }
}

/// What arrives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gathered {
    /// The sky's light, added to the irradiance that is there.
    Sky,
    /// The leaves' own light, stored.
    Bounce,
}

/// Writes `irradiance`, 3 f32 an occupied leaf, lux. `light` must hold opacity as asked for.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &LitOctree,
    (light, opacity): (&GpuBuffer, Opacity),
    (gathered, params): (Gathered, &ConeParams),
    irradiance: &GpuBuffer,
) {
    let flag = |on: bool| f64::from(u8::from(on));
    let constants = [("SKY", flag(gathered == Gathered::Sky)), ("DIRECTIONAL", flag(opacity.is_directional()))];
    let pass = frame.pass(&gpu.kernel("light/gather.wgsl", &constants));
    octree
        .ranked
        .bind(pass, &octree.sizes)
        .uniform("cone", params)
        .bind("block_keys", &octree.block_keys)
        .bind("light", light)
        .bind("leaves", &octree.leaves)
        .bind("irradiance", irradiance)
        .counted(&octree.sizes.buffer, |octree: &OctreeParams| Counted {
            threads: octree.leaf_block_count.into(),
            bytes: u64::from(octree.leaf_count) * (12 + 12 + 16),
        })
        .dispatch(octree.sizes.params.leaf_block_count.into());
}
