//! Shows the octree: one ray a pixel, occupancy as alpha (Fig. 8).

use super::Palette;
use crate::data::octree::{OctreeRef, OctreeSizes};
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::stages::fill::ranked::RankedLeaves;
use crate::stages::pixels::{Picture, ViewParams};

/// What marching reads of an octree.
#[derive(Clone, Debug)]
pub struct MarchedOctree {
    pub sizes: OctreeSizes,
    pub ranked: RankedLeaves,
    pub occupied: GpuBuffer,
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
            ranked: RankedLeaves::new(octree)?,
            occupied: masks.occupied.made("occupied masks")?,
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
    let pass = frame.pass(&gpu.kernel("view/march.wgsl", &[]));
    picture
        .bind(octree.ranked.bind(pass, &octree.sizes))
        .uniform("view", view)
        .uniform("palette", palette)
        .bind("occupied", &octree.occupied)
        .bind("leaves", &octree.leaves)
        .bind("nodes", &octree.nodes)
        .bind("leaf_objects", octree.leaf_objects.as_ref().unwrap_or(&octree.leaves))
        .dispatch(picture.tiled_threads());
}
