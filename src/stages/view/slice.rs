//! Shows a plane through the grid, sampled, in the colours of a scale.

use bytemuck::{Pod, Zeroable};

use super::{Palette, Picture, ViewParams};
use crate::gpu::{Gpu, Recorder};
use crate::settings::lighting::Opacity;
use crate::settings::{Sampling, Slice, SliceAxis, SliceValue};
use crate::stages::sample::{SampledOctree, Sampler};

pub const SLICE_OCCUPANCY: u32 = 1;
pub const SLICE_LOGARITHMIC: u32 = 2;

/// Mirror of `SliceParams` in shaders/view/slice.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SliceParams {
    pub axis: u32,
    pub height_cells: f32,
    pub at: f32,
    pub flags: u32,
    pub least: f32,
    pub most: f32,
    pub pad: [u32; 2],
}

impl SliceParams {
    /// For a grid of 2^`depth` cells an axis; `range`: values at the scale's ends, both above zero where
    /// it is logarithmic.
    pub fn new(slice: &Slice, depth: u32, range: [f64; 2]) -> Self {
        let flag = |on: bool, bit: u32| if on { bit } else { 0 };
        let axis = match slice.axis {
            SliceAxis::X => 0,
            SliceAxis::Y => 1,
            SliceAxis::Z => 2,
        };
        let at = match slice.sampling {
            Sampling::Quadrilinear => slice.width_cells,
            Sampling::Nearest | Sampling::Trilinear => f64::from(sampled_level(slice, depth)),
        };
        Self {
            axis,
            height_cells: (slice.height * f64::from(1_u32 << depth)) as f32,
            at: at as f32,
            flags: flag(slice.value == SliceValue::Occupancy, SLICE_OCCUPANCY)
                | flag(slice.logarithmic, SLICE_LOGARITHMIC),
            least: range[0] as f32,
            most: range[1] as f32,
            pad: [0; 2],
        }
    }
}

/// The level whose nodes are about as wide as the samples.
pub fn sampled_level(slice: &Slice, depth: u32) -> u32 {
    depth - (slice.width_cells.log2().round().max(0.0) as u32).min(depth)
}

/// `octree` has the light that is shown, radiance or irradiance, and the pointers of the slice's look-up.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &SampledOctree,
    (slice, range): (&Slice, [f64; 2]),
    (view, palette): (&ViewParams, &Palette),
    picture: &Picture,
) {
    // Mean values: a plane has no direction of sight.
    let sampler = Sampler { sampling: slice.sampling, lookup: slice.lookup, opacity: Opacity::Isotropic };
    let pass = frame.pass(&gpu.kernel("view/slice.wgsl", &sampler.constants()));
    octree
        .bind(pass)
        .uniform("view", view)
        .uniform("palette", palette)
        .uniform("params", &SliceParams::new(slice, octree.sizes.params.depth, range))
        .texture("picture", picture.color.view())
        .texture("depth", picture.distance.view())
        .dispatch(picture.tiled_threads());
}
