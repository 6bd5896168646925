//! Samples an array of points in place.

use bytemuck::{Pod, Zeroable};

use super::{SampledOctree, Sampler};
use crate::gpu::{Gpu, GpuBuffer, Mirror, Recorder, mirror};

/// Mirror of `PointParams` in shaders/sample/sample_points.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PointParams {
    /// Unit length.
    pub direction: [f32; 3],
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(PointParams, "sample/sample_points.wgsl", "PointParams", direction, pad)];

impl PointParams {
    pub fn new(direction: [f32; 3]) -> Self {
        Self { direction, pad: 0 }
    }
}

/// The first `count` of `points`, 4 f32 each: position in cells and level (width in cells where the
/// sampler is quadrilinear) become radiance · α and α.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &SampledOctree,
    (sampler, params): (&Sampler, &PointParams),
    points: &GpuBuffer,
    count: u64,
) {
    let pass = frame.pass(&gpu.kernel("sample/sample_points.wgsl", &sampler.constants()));
    octree.bind(pass).uniform("params", params).bind("points", points).bytes_moved(2 * 16 * count).dispatch(count);
}
