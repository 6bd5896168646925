//! Where leaves lie in a filled octree: by the ranks of their bits.

use crate::data::octree::{OctreeRef, OctreeSizes};
use crate::gpu::{GpuBuffer, GpuError, Kernel, PassBuilder};

/// What a kernel reads to find nodes and leaves by rank.
#[derive(Clone, Debug)]
pub struct RankedLeaves {
    pub leaf_bits: GpuBuffer,
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_starts: GpuBuffer,
}

impl RankedLeaves {
    /// Fails until all of it was built.
    pub fn new(octree: OctreeRef<'_>) -> Result<Self, GpuError> {
        let OctreeRef { masks, payload, .. } = octree;
        Ok(Self {
            leaf_bits: masks.leaf_bits.made("leaf bits")?,
            blocks: masks.blocks.made("block masks")?,
            ranks: masks.ranks.made("block ranks")?,
            block_starts: payload.block_starts.made("block starts")?,
        })
    }

    /// By the names in shaders/shared/block_rank.wgsl and leaf_slot.wgsl, with the octree's sizes.
    pub fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>, sizes: &OctreeSizes) -> PassBuilder<'r, Kernel> {
        pass.bind("octree", &sizes.buffer)
            .bind("leaf_bits", &self.leaf_bits)
            .bind("blocks", &self.blocks)
            .bind("ranks", &self.ranks)
            .bind("block_starts", &self.block_starts)
    }
}
