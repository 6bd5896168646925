//! Shows the light that the octree holds: one ray a pixel, as [`super::march`].

use bytemuck::{Pod, Zeroable};

use super::{Picture, ViewParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::stages::light::LitOctree;

/// Mirror of `ExposureParams` in shaders/view/march_light.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ExposureParams {
    pub factor: f32,
}

/// `light`: radiance or irradiance of all nodes, shown times `factor`.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &LitOctree,
    (light, factor): (&GpuBuffer, f32),
    view: &ViewParams,
    picture: &Picture,
) {
    frame
        .pass(&gpu.kernel("view/march_light.wgsl", &[]))
        .bind("octree", &octree.sizes.buffer)
        .uniform("view", view)
        .uniform("exposure", &ExposureParams { factor })
        .bind("leaf_bits", &octree.leaf_bits)
        .bind("occupied", &octree.occupied)
        .bind("blocks", &octree.blocks)
        .bind("ranks", &octree.ranks)
        .bind("block_starts", &octree.block_starts)
        .bind("light", light)
        .texture("picture", picture.color.view())
        .texture("depth", picture.distance.view())
        .dispatch(picture.tiled_threads());
}
