//! Shows the moved leaves over the exact ones: holes, spill, and what both have.

use super::GhostColors;
use crate::data::octree::OctreeSizes;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::stages::pixels::{Picture, ViewParams};

/// Leaf bits and the masks of all levels above them (`occupied`) of one set of leaves.
#[derive(Clone, Debug)]
pub struct LeafSet {
    pub leaf_bits: GpuBuffer,
    pub occupied: GpuBuffer,
}

/// `view.level` must be the leaves' level.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeSizes,
    (moved, exact): (&LeafSet, &LeafSet),
    (view, colors): (&ViewParams, &GhostColors),
    picture: &Picture,
) {
    let pass = frame.pass(&gpu.kernel("view/ghost.wgsl", &[]));
    picture
        .bind(pass)
        .bind("octree", &octree.buffer)
        .uniform("view", view)
        .uniform("ghost", colors)
        .bind("moved_bits", &moved.leaf_bits)
        .bind("moved_occupied", &moved.occupied)
        .bind("exact_bits", &exact.leaf_bits)
        .bind("exact_occupied", &exact.occupied)
        .dispatch(picture.tiled_threads());
}
