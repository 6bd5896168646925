//! What holds an octree: its sizes, which the GPU knows first, and its buffers, by what they depend on.
//!
//! ```text
//! masks      which cells hold something: sizes are known before anything is built
//! topology   the nodes and who is below whom: as many as the masks say
//! payload    what the voxels leave in them
//! ```
//!
//! They grow with what is built and are kept for the next build.

use super::octree::{OctreeParams, Slot};
use crate::gpu::{Gpu, GpuBuffer, GpuError};

#[derive(Debug, Default)]
pub struct MaskBuffers {
    pub leaf_bits: Slot,
    pub occupied: Slot,
    pub blocks: Slot,
    pub ranks: Slot,
    pub counters: Slot,
    pub scan_sums: Vec<Slot>,
}

#[derive(Debug, Default)]
pub struct TopologyBuffers {
    pub block_keys: Slot,
    pub first_child: Slot,
    /// 0 and the occupied leaves of each leaf block.
    pub block_counts: Slot,
}

#[derive(Debug, Default)]
pub struct PayloadBuffers {
    /// The topology's, with voxels counted.
    pub block_counts: Slot,
    pub block_starts: Slot,
    pub places: Slot,
    pub sorted_voxels: Slot,
    pub leaves: Slot,
    pub nodes: Slot,
    pub heavy_blocks: Slot,
    pub scan_sums: Vec<Slot>,
}

/// How large an octree is.
#[derive(Clone, Debug)]
pub struct OctreeSizes {
    /// As far as the CPU knows: exact, or a prediction, which is an upper bound. Buffers and dispatches are as
    /// large.
    pub params: OctreeParams,
    /// What kernels read: the truth, an `OctreeParams` in a uniform.
    pub buffer: GpuBuffer,
}

impl OctreeSizes {
    /// Exact ones, or a prediction: its shape holds, its counts until the GPU knows better.
    pub fn upload(gpu: &Gpu, params: &OctreeParams) -> Result<Self, GpuError> {
        Self::write(gpu, &mut Slot::default(), params)
    }

    /// The same in a buffer that is kept.
    pub fn write(gpu: &Gpu, slot: &mut Slot, params: &OctreeParams) -> Result<Self, GpuError> {
        let bytes = size_of::<OctreeParams>() as u64;
        let buffer = slot.ensure_as(gpu, "octree sizes", bytes, wgpu::BufferUsages::UNIFORM)?;
        gpu.write(&buffer, 0, bytemuck::bytes_of(params))?;
        Ok(Self { params: *params, buffer })
    }
}

/// All of one octree.
#[derive(Clone, Copy, Debug)]
pub struct OctreeRef<'a> {
    pub sizes: &'a OctreeSizes,
    pub masks: &'a MaskBuffers,
    pub topology: &'a TopologyBuffers,
    pub payload: &'a PayloadBuffers,
}
