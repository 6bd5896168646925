//! The same as [`super::direct`], hidden by the leaves of the octree.

use super::Lit;
use crate::gpu::{Gpu, Recorder};
use crate::stages::light::LitOctree;
use crate::stages::light::illuminate::LightParams;

/// Shadow rays start `light.offset_cells` above the triangle.
pub fn record(gpu: &Gpu, frame: &mut Recorder, lit: &Lit<'_>, light: &LightParams, octree: &LitOctree) {
    let pass = frame.pass(&gpu.kernel("surface/direct_march.wgsl", &[]));
    octree.bind_leaves(lit.bind(pass)).uniform("light", light).bytes_moved(lit.bytes(2)).dispatch(lit.tiled_threads());
}
