//! Where the fragments of a frame lie, and how a cell finds its own.

use crate::data::fragments::{EMISSION_WORDS, FRAGMENT_WORDS, FragmentCounts, FragmentRoom};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::settings::VoxelizerCells;

const UNIFORM: wgpu::BufferUsages = wgpu::BufferUsages::UNIFORM;

/// Buffers that last from frame to frame.
#[derive(Debug, Default)]
pub struct CellStoreBuffers {
    pub heads: Slot,
    pub fragments: Slot,
    pub counts: Slot,
}

/// Those of a frame, and the room in them.
#[derive(Clone, Debug)]
pub struct CellStore {
    pub heads: GpuBuffer,
    pub fragments: GpuBuffer,
    /// [`FragmentCounts`].
    pub counts: GpuBuffer,
    pub room: FragmentRoom,
    cells: VoxelizerCells,
    emits: bool,
}

impl CellStore {
    /// `room` for this many fragments and voxels, in a grid of 2^`depth` cells along an axis. Buckets are a cell each, or
    /// at least as many as fragments.
    pub fn new(
        gpu: &Gpu,
        buffers: &mut CellStoreBuffers,
        (cells, depth): (VoxelizerCells, u32),
        room: FragmentRoom,
        emits: bool,
    ) -> Result<Self, GpuError> {
        let bucket_bits = match cells {
            VoxelizerCells::Dense => 3 * depth,
            VoxelizerCells::Sparse => room.fragments.max(2).next_power_of_two().ilog2(),
        };
        let bytes = Self::bytes_of_fragment(emits) * u64::from(room.fragments.max(1));
        Ok(Self {
            heads: buffers.heads.ensure(gpu, "cells of the voxelizer", 4 * ((1 << bucket_bits) + 1))?,
            fragments: buffers.fragments.ensure(gpu, "fragments", bytes)?,
            counts: buffers.counts.ensure_as(gpu, "fragment counts", size_of::<FragmentCounts>() as u64, UNIFORM)?,
            room: FragmentRoom { bucket_bits, ..room },
            cells,
            emits,
        })
    }

    pub fn bytes_of_fragment(emits: bool) -> u64 {
        4 * u64::from(FRAGMENT_WORDS + if emits { EMISSION_WORDS } else { 0 })
    }

    pub(super) fn fragment_bytes(&self) -> u64 {
        Self::bytes_of_fragment(self.emits)
    }

    /// Every cell is empty.
    pub fn record_clear(&self, frame: &mut Recorder) {
        frame.clear_part(&self.heads, 4 * ((1 << self.room.bucket_bits) + 1));
    }

    pub(super) fn constants(&self) -> [(&'static str, f64); 2] {
        let flag = |set: bool| f64::from(u8::from(set));
        [("DENSE", flag(self.cells == VoxelizerCells::Dense)), ("EMITS", flag(self.emits))]
    }
}
