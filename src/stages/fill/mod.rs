//! Fills the leaves (section 4.3's "moving weighted average", here exact and order-free): a counting
//! sort of the world voxels by leaf block, then one thread a block gathers integer sums.

pub mod count;
pub mod count_ref;
pub mod gather;
pub mod gather_emission;
pub mod gather_emission_ref;
pub mod gather_heavy;
pub mod gather_heavy_ref;
pub mod gather_ref;
pub mod number_objects;
pub mod number_objects_ref;
pub mod place;
pub mod place_emission;
pub mod place_emission_ref;
pub mod place_ref;
pub mod ranked;

use crate::data::octree::{MAX_FRAGMENTS, MaskBuffers, OctreeRef, OctreeSizes, PayloadBuffers, Slot, TopologyBuffers};
use crate::data::pages::WORLD_VOXEL_BYTES;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Kernel, PassBuilder, Recorder};

/// What gathering reads and writes; see `data::octree`.
#[derive(Clone, Debug)]
pub struct Filling {
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_keys: GpuBuffer,
    pub block_counts: GpuBuffer,
    pub block_starts: GpuBuffer,
    pub places: GpuBuffer,
    pub sorted_voxels: GpuBuffer,
    pub leaves: GpuBuffer,
    pub nodes: GpuBuffer,
    pub heavy_blocks: GpuBuffer,
}

impl Filling {
    /// With room for so many voxels; the topology must be there.
    pub fn new(
        gpu: &Gpu,
        sizes: &OctreeSizes,
        masks: &MaskBuffers,
        topology: &TopologyBuffers,
        payload: &mut PayloadBuffers,
        voxel_threads: u32,
    ) -> Result<Self, GpuError> {
        let voxels = u64::from(voxel_threads);
        let leaf_blocks = u64::from(sizes.params.leaf_block_count);
        let (leaves, nodes) = (u64::from(sizes.params.leaf_count), u64::from(sizes.params.inner_node_count));
        let ensure = |slot: &mut Slot, label: &str, bytes| slot.ensure(gpu, label, bytes).map(drop);
        ensure(&mut payload.block_counts, "block counts", 8 * leaf_blocks)?;
        ensure(&mut payload.block_starts, "block starts", 8 * (leaf_blocks + 1))?;
        ensure(&mut payload.places, "sorting places", 8 * voxels)?;
        ensure(&mut payload.sorted_voxels, "sorted voxels", WORLD_VOXEL_BYTES * voxels)?;
        ensure(&mut payload.leaves, "leaves", 12 * leaves)?;
        ensure(&mut payload.nodes, "nodes", 16 * nodes)?;
        ensure(&mut payload.heavy_blocks, "heavy blocks", heavy_bytes(voxels))?;
        Self::made(OctreeRef { sizes, masks, topology, payload })
    }

    /// The buffers of an octree that was filled before.
    pub fn made(octree: OctreeRef<'_>) -> Result<Self, GpuError> {
        let OctreeRef { masks, topology, payload, .. } = octree;
        Ok(Self {
            blocks: masks.blocks.made("block masks")?,
            ranks: masks.ranks.made("block ranks")?,
            block_keys: topology.block_keys.made("block keys")?,
            block_counts: payload.block_counts.made("block counts")?,
            block_starts: payload.block_starts.made("block starts")?,
            places: payload.places.made("sorting places")?,
            sorted_voxels: payload.sorted_voxels.made("sorted voxels")?,
            leaves: payload.leaves.made("leaves")?,
            nodes: payload.nodes.made("nodes")?,
            heavy_blocks: payload.heavy_blocks.made("heavy blocks")?,
        })
    }

    /// By the names in shaders/shared/block_sources.wgsl and leaf_block.wgsl, with the sorted voxels.
    fn bind_sources<'r>(&self, pass: PassBuilder<'r, Kernel>, sizes: &OctreeSizes) -> PassBuilder<'r, Kernel> {
        pass.bind("octree", &sizes.buffer)
            .bind("blocks", &self.blocks)
            .bind("ranks", &self.ranks)
            .bind("block_keys", &self.block_keys)
            .bind("block_starts", &self.block_starts)
            .bind("sorted_voxels", &self.sorted_voxels)
    }

    /// Before voxels are counted: the payload's own copy of what the topology counted, so that the next payload
    /// may start from the same, and nodes that hold nothing.
    pub fn record_start(
        &self,
        frame: &mut Recorder,
        octree: &OctreeSizes,
        topology: &TopologyBuffers,
    ) -> Result<(), GpuError> {
        let counted = topology.block_counts.made("block counts")?;
        frame.copy(&counted, 0, &self.block_counts, 0, 8 * u64::from(octree.params.leaf_block_count));
        frame.clear_part(&self.nodes, 16 * u64::from(octree.params.inner_node_count));
        frame.clear_part(&self.heavy_blocks, 4);
        Ok(())
    }
}

/// Each voxel is a source of at most 8 blocks, each heavy one has more than [`MAX_FRAGMENTS`]; a word says how
/// many there are.
fn heavy_bytes(voxels: u64) -> u64 {
    4 * (2 + 8 * voxels / u64::from(MAX_FRAGMENTS))
}
