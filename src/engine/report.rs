//! What the last build made, in numbers.

use serde::Serialize;

use super::built_octree::BuiltOctree;
use super::{Engine, other_filter};
use crate::data::light::{IRRADIANCE_BYTES, light_bytes};
use crate::data::octree::{FULL_WEIGHT, PointerLayout};
use crate::settings::Filter;

/// One level of the octree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct LevelReport {
    pub level: u32,
    /// Stored nodes.
    pub nodes: u64,
    /// Nodes with something below them.
    pub occupied: u64,
    /// Stored nodes that hold nothing: kept so that interpolation finds every corner, or because a
    /// sibling, or the dense level, is stored.
    pub dummies: u64,
    pub bytes: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OctreeReport {
    pub filter: Filter,
    pub levels: Vec<LevelReport>,
    /// Moved voxels.
    pub voxels: u64,
    /// Weights are in 2^-24 voxels: kept + clipped = 2^24 · voxels, and what occupancies above
    /// one lost is excess: kept − excess = occupancy.
    pub kept_weight: u64,
    pub clipped_weight: u64,
    pub excess_weight: u64,
    pub bytes: u64,
    /// Light of all nodes and irradiance of all leaves; 0 while there is none.
    pub light_bytes: u64,
    /// What neighbour pointers take, whether they are made or not: stored once a block, and once a node.
    pub pointer_bytes: [u64; 2],
}

/// Moved voxels against the exact voxelization of the same pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FilterReport {
    pub filter: Filter,
    /// Transform and build, all kernels.
    pub kernel_ms: f64,
    pub voxels: u64,
    pub leaves: u64,
    pub nodes: u64,
    pub bytes: u64,
    /// Exact cells that no moved voxel reaches, and moved cells that are not exact ones; `None`
    /// while the exact set is not known.
    pub holes: Option<u64>,
    pub spill: Option<u64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AccuracyReport {
    pub nearest: Option<FilterReport>,
    pub split: Option<FilterReport>,
    pub exact_cells: Option<u64>,
}

/// Payload and child pointer of an inner node; record of a leaf; key, counts and starts of a block.
const INNER_NODE_BYTES: u64 = 16 + 4;
const LEAF_BYTES: u64 = 12;
const BLOCK_BYTES: u64 = 4 + 8;

impl BuiltOctree {
    pub fn levels(&self) -> Vec<LevelReport> {
        let level = |level: u32| {
            let nodes = u64::from(self.params.node_count(level));
            let occupied = u64::from(self.occupied.get(level as usize).copied().unwrap_or(0));
            let bytes = if level == self.params.depth {
                occupied * LEAF_BYTES + u64::from(self.params.leaf_block_count) * BLOCK_BYTES
            } else {
                nodes * INNER_NODE_BYTES
            };
            LevelReport { level, nodes, occupied, dummies: nodes - occupied, bytes }
        };
        (0..=self.params.depth).map(level).collect()
    }
}

impl Engine {
    /// Of the octree that is shown; `None` while there is none, or nothing for it to hold.
    pub fn octree_report(&self) -> Option<OctreeReport> {
        if !self.has_octree() {
            return None;
        }
        let voxels = u64::from(self.voxel_threads()?);
        let levels = self.shown.levels();
        let kept_weight = voxels * u64::from(FULL_WEIGHT) - self.shown.clipped_weight;
        Some(OctreeReport {
            filter: self.shown.filter,
            voxels,
            kept_weight,
            clipped_weight: self.shown.clipped_weight,
            excess_weight: kept_weight - self.shown.occupancy,
            bytes: levels.iter().map(|level| level.bytes).sum(),
            light_bytes: self.light_bytes(),
            pointer_bytes: [PointerLayout::Blocks, PointerLayout::Nodes]
                .map(|layout| 4 * layout.words(&self.shown.params)),
            levels,
        })
    }

    fn light_bytes(&self) -> u64 {
        let Some(lit_by) = &self.done.light else { return 0 };
        let leaves = u64::from(self.shown.params.leaf_count);
        let b = &self.light.buffers;
        let a_leaf = [&b.direct, &b.gathered, &b.leaf_emission].into_iter().filter(|slot| slot.get().is_some()).count();
        light_bytes(&self.shown.params, lit_by.lighting.opacity) + IRRADIANCE_BYTES * leaves * a_leaf as u64
    }

    /// Both filters side by side, as far as they are built for the pose that is shown.
    pub fn accuracy(&self) -> Option<AccuracyReport> {
        let (shown_filter, _) = self.done.octree.filter(|_| self.has_octree())?;
        let compared = self.done.compared.as_ref();
        let shown = self.filter_report(&self.shown, compared.and(self.comparison.shown));
        let other = self.done.other.and_then(|_| self.filter_report(&self.other, compared.and(self.comparison.other)));
        debug_assert!(other.is_none_or(|other| other.filter == other_filter(shown_filter)));
        let (nearest, split) = match shown_filter {
            Filter::Nearest => (shown, other),
            Filter::Split => (other, shown),
        };
        Some(AccuracyReport { nearest, split, exact_cells: compared.map(|exact| exact.count) })
    }

    fn filter_report(&self, octree: &BuiltOctree, counts: Option<[u64; 3]>) -> Option<FilterReport> {
        let levels = octree.levels();
        let moved_ms: f64 = self.timings.moved.iter().map(|timing| timing.ms).sum();
        Some(FilterReport {
            filter: octree.filter,
            kernel_ms: moved_ms + octree.kernel_ms(),
            voxels: u64::from(self.voxel_threads()?),
            leaves: u64::from(octree.params.leaf_count),
            nodes: levels.iter().map(|level| level.nodes).sum(),
            bytes: levels.iter().map(|level| level.bytes).sum(),
            holes: counts.map(|counts| counts[0]),
            spill: counts.map(|counts| counts[1]),
        })
    }

    fn voxel_threads(&self) -> Option<u32> {
        Some(self.scene.as_ref()?.moving_voxels()?.threads())
    }
}
