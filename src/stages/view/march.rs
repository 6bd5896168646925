//! Shows the octree: one ray a pixel, occupancy as alpha (Fig. 8).

use super::{Palette, Picture, ViewParams};
use crate::data::octree::{OctreeRef, OctreeSizes};
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};

/// What marching reads of an octree.
#[derive(Clone, Debug)]
pub struct MarchedOctree {
    pub sizes: OctreeSizes,
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
    /// Fails until all of it was built.
    pub fn new(octree: OctreeRef<'_>, leaf_objects: Option<&GpuBuffer>) -> Result<Self, GpuError> {
        let OctreeRef { sizes, masks, payload, .. } = octree;
        Ok(Self {
            sizes: sizes.clone(),
            leaf_bits: masks.leaf_bits.made("leaf bits")?,
            occupied: masks.occupied.made("occupied masks")?,
            blocks: masks.blocks.made("block masks")?,
            ranks: masks.ranks.made("block ranks")?,
            block_starts: payload.block_starts.made("block starts")?,
            leaves: payload.leaves.made("leaves")?,
            nodes: payload.nodes.made("nodes")?,
            leaf_objects: leaf_objects.cloned(),
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
        .bind("octree", &octree.sizes.buffer)
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
