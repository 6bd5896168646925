//! Shows a plane through the grid, sampled, in the colours of a scale.

use bytemuck::{Pod, Zeroable};

use super::Palette;
use crate::gpu::{Constant, Gpu, Mirror, Recorder, constants, mirror};
use crate::settings::lighting::Opacity;
use crate::settings::{Sampling, Slice, SliceAxis, SliceValue};
use crate::stages::pixels::{Picture, ViewParams};
use crate::stages::sample::{SampledOctree, Sampler};

pub const SLICE_OCCUPANCY: u32 = 1;
pub const SLICE_LOGARITHMIC: u32 = 2;
pub const SLICE_OF_MEAN: u32 = 4;

pub const CONSTANTS: &[Constant] = constants![
    integer SLICE_LOGARITHMIC,
    integer SLICE_OCCUPANCY,
    integer SLICE_OF_MEAN,
];

/// Ends of a scale around the mean light, in means: light spans many powers of two.
const LOGARITHMIC_MEANS: [f64; 2] = [1.0 / 256.0, 16.0];
const LINEAR_MEANS: [f64; 2] = [0.0, 8.0];
/// Of a scale of occupancies.
const LOGARITHMIC_SHARES: [f64; 2] = [1.0 / 4096.0, 1.0];
const LINEAR_SHARES: [f64; 2] = [0.0, 1.0];

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

pub const MIRRORS: &[Mirror] =
    &[mirror!(SliceParams, "view/slice.wgsl", "SliceParams", axis, height_cells, at, flags, least, most, pad)];

impl SliceParams {
    /// For a grid of 2^`depth` cells an axis; `range`: values at the scale's ends, both above zero where
    /// it is logarithmic; `None`: as [`range_of_mean`] has them.
    pub fn new(slice: &Slice, depth: u32, range: Option<[f64; 2]>) -> Self {
        let flag = |on: bool, bit: u32| if on { bit } else { 0 };
        // A mean of 1 leaves the means that the ends are.
        let [least, most] = range.unwrap_or_else(|| range_of_mean(slice, None));
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
                | flag(slice.logarithmic, SLICE_LOGARITHMIC)
                | flag(range.is_none() && slice.value != SliceValue::Occupancy, SLICE_OF_MEAN),
            least: least as f32,
            most: most as f32,
            pad: [0; 2],
        }
    }
}

/// The level whose nodes are about as wide as the samples.
pub fn sampled_level(slice: &Slice, depth: u32) -> u32 {
    depth - (slice.width_cells.log2().round().max(0.0) as u32).min(depth)
}

/// Ends of the scale where none are given: around the luminance of the mean light, 1 where there is none;
/// occupancy has ends of its own.
pub fn range_of_mean(slice: &Slice, mean: Option<f64>) -> [f64; 2] {
    let is_light = slice.value != SliceValue::Occupancy;
    match (is_light, slice.logarithmic) {
        (true, true) => LOGARITHMIC_MEANS.map(|means| means * mean.unwrap_or(1.0)),
        (true, false) => LINEAR_MEANS.map(|means| means * mean.unwrap_or(1.0)),
        (false, true) => LOGARITHMIC_SHARES,
        (false, false) => LINEAR_SHARES,
    }
}

/// `octree` has the light that is shown, radiance or irradiance, and the pointers of the slice's look-up. Without
/// a `range`, that light's own mean makes it.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &SampledOctree,
    (slice, range): (&Slice, Option<[f64; 2]>),
    (view, palette): (&ViewParams, &Palette),
    picture: &Picture,
) {
    // Mean values: a plane has no direction of sight.
    let sampler = Sampler { sampling: slice.sampling, lookup: slice.lookup, opacity: Opacity::Isotropic };
    let pass = frame.pass(&gpu.kernel("view/slice.wgsl", &sampler.constants()));
    octree
        .bind(picture.bind(pass))
        .uniform("view", view)
        .uniform("palette", palette)
        .uniform("params", &SliceParams::new(slice, octree.sizes.params.depth, range))
        .dispatch(picture.tiled_threads());
}
