//! Brings the leaves back: the world cells as they are after transformation.

use glam::DVec3;

use super::super::{Engine, EngineError};
use crate::data::albedo::unpack_albedo;
use crate::data::grid::morton_cell;
use crate::data::octree::{FULL_WEIGHT, Slot};
use crate::data::packing::unpack_normal;
use crate::data::world_voxels::WorldVoxels;
use crate::gpu::GpuError;

/// Mean normals shorter than this have no direction: half a step of the packing.
const CANCELLED_LENGTH: f64 = 0.5 / crate::data::packing::NORMAL_MAX as f64;

impl Engine {
    /// The leaves of the octree that is shown. Blocks until they are here.
    pub fn read_voxels(&self) -> Result<WorldVoxels, EngineError> {
        let mut voxels = WorldVoxels::default();
        let Some(built) = self.shown_octree() else { return Ok(voxels) };
        let octree = &built.counts.params;
        let (bits, leaves) = (&built.masks.buffers.leaf_bits, &built.payload.buffers.leaves);
        let leaf_bits: Vec<u32> = self.read_all(bits, "leaf bits", (1 << (3 * octree.depth)) / 32)?;
        let leaves: Vec<u32> = self.read_all(leaves, "leaves", 3 * u64::from(octree.leaf_count))?;
        // Leaves are stored in key order, so the set bits name them one after the other.
        let keys = leaf_bits.iter().enumerate().flat_map(|(word, &bits)| {
            (0..32).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| 32 * word as u32 + bit)
        });
        for (key, leaf) in keys.zip(leaves.chunks_exact(3)) {
            voxels.cells.push(morton_cell(key).map(|c| c as i32));
            voxels.occupancy.push((f64::from(leaf[0]) / f64::from(FULL_WEIGHT)) as f32);
            voxels.albedo.push(unpack_albedo(leaf[1]).map(|channel| channel as f32));
            voxels.normal.push(direction(unpack_normal(leaf[2])));
        }
        Ok(voxels)
    }

    fn read_all(&self, slot: &Slot, label: &str, words: u64) -> Result<Vec<u32>, GpuError> {
        self.gpu.read(&slot.made(label)?, 0..4 * words)
    }
}

fn direction(mean: DVec3) -> [f32; 3] {
    if mean.length() < CANCELLED_LENGTH { [0.0; 3] } else { mean.normalize().as_vec3().to_array() }
}
