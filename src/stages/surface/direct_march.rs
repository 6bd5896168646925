//! The same as [`super::direct`], hidden by the leaves of the octree.

use super::Lit;
use crate::gpu::{Gpu, Recorder};
use crate::stages::light::LitOctree;
use crate::stages::light::illuminate::LightParams;

/// Shadow rays start `light.offset_cells` above the triangle.
pub fn record(gpu: &Gpu, frame: &mut Recorder, lit: &Lit<'_>, light: &LightParams, octree: &LitOctree) {
    let pass = frame.pass(&gpu.kernel("surface/direct_march.wgsl", &[]));
    lit.bind(pass)
        .uniform("light", light)
        .bind("octree", &octree.sizes.buffer)
        .bind("leaf_bits", &octree.leaf_bits)
        .bind("occupied", &octree.occupied)
        .bind("blocks", &octree.blocks)
        .bind("ranks", &octree.ranks)
        .bind("block_starts", &octree.block_starts)
        .bind("leaves", &octree.leaves)
        .bytes_moved(lit.bytes(2))
        .dispatch(lit.tiled_threads());
}
