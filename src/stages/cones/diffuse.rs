//! Diffuse cones of the surfaces that the camera sees.

use bytemuck::{Pod, Zeroable};

use super::{ConesInput, image_bytes, tiled_threads};
use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};
use crate::settings::ConeTracing;
use crate::stages::light::gather::{ConeShape, Cones};
use crate::stages::sample::Sampler;

/// Mirror of `DiffuseParams` in shaders/cones/diffuse.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DiffuseParams {
    pub sky: [f32; 3],
    pub count: u32,
    pub shape: ConeShape,
    pub size_px: [u32; 2],
    pub pattern_px: u32,
    pub occlusion_cells: f32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(
    DiffuseParams,
    "cones/diffuse.wgsl",
    "DiffuseParams",
    sky,
    count,
    shape,
    size_px,
    pattern_px,
    occlusion_cells
)];

/// What the cones of a pixel are, beside the octree's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseCones {
    pub cones: Cones,
    /// Side of the square of pixels that shares a set of `cones.count` times its area.
    pub pattern_px: u32,
    /// What is farther away occludes nothing.
    pub occlusion_cells: f64,
}

impl DiffuseCones {
    /// In a grid of `grid_cells`³ cells of `span` scene units.
    pub fn new(settings: &ConeTracing, grid_cells: u32, span: f64) -> Self {
        Self {
            cones: Cones {
                count: settings.cones,
                aperture_degrees: settings.cone_degrees,
                start_cells: settings.start_voxels,
                step_diameters: settings.step_diameters,
                reach_cells: f64::INFINITY,
            },
            pattern_px: settings.pattern_px,
            occlusion_cells: settings.occlusion_cells(grid_cells, span),
        }
    }

    /// Directions of a whole pattern.
    pub fn directions(&self) -> u32 {
        self.cones.count * self.pattern_px * self.pattern_px
    }
}

impl DiffuseParams {
    /// `sky`: radiance from all directions, nits.
    pub fn new(cones: &DiffuseCones, sky: [f32; 3], size_px: [u32; 2]) -> Self {
        Self {
            sky,
            count: cones.cones.count,
            shape: ConeShape::new(&cones.cones),
            size_px,
            pattern_px: cones.pattern_px,
            occlusion_cells: cones.occlusion_cells as f32,
        }
    }
}

/// What diffuse cones are for; without either there is nothing to trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DiffuseTerms {
    /// Without it the radiance is the sky's in the open share, and cones end with the occlusion.
    pub radiance: bool,
    /// Without it the open share is 1.
    pub occlusion: bool,
}

/// Writes `diffuse`, a vec4 a pixel of `params.size_px`. The octree's light must hold the sampler's opacity.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    input: &ConesInput<'_>,
    (sampler, terms): (&Sampler, DiffuseTerms),
    params: &DiffuseParams,
    diffuse: &GpuBuffer,
) {
    let flag = |on: bool| f64::from(u8::from(on));
    let mut constants = sampler.constants().to_vec();
    constants.extend([("HORIZON", 1.0), ("RADIANCE", flag(terms.radiance)), ("OCCLUSION", flag(terms.occlusion))]);
    let pass = frame.pass(&gpu.kernel("cones/diffuse.wgsl", &constants));
    input
        .surfaces
        .bind(input.octree.bind(pass))
        .uniform("params", params)
        .bind("diffuse", diffuse)
        .bytes_moved(3 * image_bytes(params.size_px))
        .dispatch(tiled_threads(params.size_px));
}
