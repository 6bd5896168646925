//! Shows the light that the octree holds: one ray a pixel, as [`super::march`].

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};
use crate::stages::light::LitOctree;
use crate::stages::pixels::{Picture, ViewParams};

/// Mirror of `ExposureParams` in shaders/view/march_light.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ExposureParams {
    pub factor: f32,
    pub automatic: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(ExposureParams, "view/march_light.wgsl", "ExposureParams", factor, automatic)];

/// What light is multiplied by before it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    Set(f64),
    /// The mean of all light that is stored is shown as [`crate::stages::pixels::MEAN_SHOWN_AS`]; 1 where there is none.
    OfMean,
}

impl ExposureParams {
    pub fn new(exposure: Exposure) -> Self {
        match exposure {
            Exposure::Set(factor) => Self { factor: factor as f32, automatic: 0 },
            Exposure::OfMean => Self { factor: 1.0, automatic: 1 },
        }
    }
}

/// `light`: radiance or irradiance of all nodes.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &LitOctree,
    (light, exposure): (&GpuBuffer, Exposure),
    view: &ViewParams,
    picture: &Picture,
) {
    let pass = frame.pass(&gpu.kernel("view/march_light.wgsl", &[]));
    picture
        .bind(octree.ranked.bind(pass, &octree.sizes))
        .uniform("view", view)
        .uniform("exposure", &ExposureParams::new(exposure))
        .bind("occupied", &octree.occupied)
        .bind("light", light)
        .dispatch(picture.tiled_threads());
}
