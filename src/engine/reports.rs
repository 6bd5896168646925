//! What is told of a frame, in numbers.

use serde::Serialize;

use super::{BuildTimes, PassTiming};
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
    /// Weights are in 2^-24 voxels: kept + clipped = 2^24 · voxels, and excess is what occupancies above
    /// one lost and what masks and blended surfaces leave uncovered: kept − excess = occupancy.
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
    /// The same of the last builds with this filter.
    #[serde(skip)]
    pub times: BuildTimes,
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

impl AccuracyReport {
    pub fn of(&self, filter: Filter) -> Option<FilterReport> {
        match filter {
            Filter::Nearest => self.nearest,
            Filter::Split => self.split,
        }
    }
}

/// All of it, taken down when the frame is finished.
#[derive(Clone, Debug)]
pub struct Results {
    pub octree: Option<OctreeReport>,
    pub accuracy: Option<AccuracyReport>,
    pub timings: Vec<PassTiming>,
    pub exposure: f64,
    pub value_range: Option<[f64; 2]>,
    pub glossy_tiles: u32,
}
