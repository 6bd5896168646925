//! Shows the octree: one ray a pixel, occupancy as alpha (Fig. 8).

use super::{Palette, Picture, ViewParams};
use crate::data::octree::{OctreeBuffers, OctreeParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// What marching reads of an octree.
#[derive(Clone, Debug)]
pub struct MarchedOctree {
    pub params: OctreeParams,
    pub leaf_bits: GpuBuffer,
    pub occupied: GpuBuffer,
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_starts: GpuBuffer,
    pub leaves: GpuBuffer,
    pub nodes: GpuBuffer,
    /// Needed only where colour is by object.
    pub leaf_objects: Option<GpuBuffer>,
}

impl MarchedOctree {
    /// `None` until all of it was built.
    pub fn new(params: &OctreeParams, buffers: &OctreeBuffers) -> Option<Self> {
        Some(Self {
            params: *params,
            leaf_bits: buffers.leaf_bits.get()?.clone(),
            occupied: buffers.occupied.get()?.clone(),
            blocks: buffers.blocks.get()?.clone(),
            ranks: buffers.ranks.get()?.clone(),
            block_starts: buffers.block_starts.get()?.clone(),
            leaves: buffers.leaves.get()?.clone(),
            nodes: buffers.nodes.get()?.clone(),
            leaf_objects: buffers.leaf_objects.get().cloned(),
        })
    }
}

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &MarchedOctree,
    (view, palette): (&ViewParams, &Palette),
    picture: &Picture,
) {
    frame
        .pass(&gpu.kernel("view/march.wgsl", &[]))
        .uniform("octree", &octree.params)
        .uniform("view", view)
        .uniform("palette", palette)
        .bind("leaf_bits", &octree.leaf_bits)
        .bind("occupied", &octree.occupied)
        .bind("blocks", &octree.blocks)
        .bind("ranks", &octree.ranks)
        .bind("block_starts", &octree.block_starts)
        .bind("leaves", &octree.leaves)
        .bind("nodes", &octree.nodes)
        .bind("leaf_objects", octree.leaf_objects.as_ref().unwrap_or(&octree.leaves))
        .texture("picture", picture.color.view())
        .texture("depth", picture.distance.view())
        .dispatch(picture.tiled_threads());
}
