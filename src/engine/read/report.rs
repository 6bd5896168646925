//! What the last build made, in numbers.

use serde::Serialize;

use super::super::request::Request;
use super::super::{BuildTimes, Engine};
use super::Built;
use crate::data::light::{IRRADIANCE_BYTES, light_bytes};
use crate::data::octree::{FULL_WEIGHT, OctreeParams, PointerLayout};
use crate::plan::{Keys, Part, Pass, calls_for};
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

/// Payload and child pointer of an inner node; record of a leaf; key, counts and starts of a block.
const INNER_NODE_BYTES: u64 = 16 + 4;
const LEAF_BYTES: u64 = 12;
const BLOCK_BYTES: u64 = 4 + 8;

impl Built<'_> {
    fn levels(&self) -> Vec<LevelReport> {
        let params = &self.counts.params;
        let level = |level: u32| {
            let nodes = u64::from(params.node_count(level));
            let occupied = u64::from(self.counts.occupied.get(level as usize).copied().unwrap_or(0));
            let bytes = if level == params.depth {
                occupied * LEAF_BYTES + u64::from(params.leaf_block_count) * BLOCK_BYTES
            } else {
                nodes * INNER_NODE_BYTES
            };
            LevelReport { level, nodes, occupied, dummies: nodes - occupied, bytes }
        };
        (0..=params.depth).map(level).collect()
    }
}

impl Engine {
    /// Of the octree that is shown; `None` while there is none, or nothing for it to hold.
    pub fn octree_report(&self) -> Option<&OctreeReport> {
        self.shown.as_ref()?.results.octree.as_ref()
    }

    /// Every filter that is measured, as far as its octree is built for the pose that is shown.
    pub fn accuracy(&self) -> Option<AccuracyReport> {
        self.shown.as_ref()?.results.accuracy
    }

    pub(super) fn report_octree(&self, request: &Request, keys: &Keys) -> Option<OctreeReport> {
        let built = self.built(keys)?;
        let (params, levels) = (&built.counts.params, built.levels());
        let voxels = u64::from(built.masks.voxels);
        let kept_weight = voxels * u64::from(FULL_WEIGHT) - built.counts.clipped_weight;
        Some(OctreeReport {
            filter: built.masks.filter,
            voxels,
            kept_weight,
            clipped_weight: built.counts.clipped_weight,
            excess_weight: kept_weight - built.payload.occupancy,
            bytes: levels.iter().map(|level| level.bytes).sum(),
            light_bytes: light_bytes_of(request, keys, &built.counts.params),
            pointer_bytes: [PointerLayout::Blocks, PointerLayout::Nodes].map(|layout| 4 * layout.words(params)),
            levels,
        })
    }

    pub(super) fn report_accuracy(&self, request: &Request, methods: &[Keys]) -> Option<AccuracyReport> {
        let reports: Vec<FilterReport> = methods.iter().filter_map(|keys| self.filter_report(keys)).collect();
        let of = |filter: Filter| reports.iter().find(|report| report.filter == filter).copied();
        let is_compared = reports.first()?.holes.is_some();
        let exact = request.shot.exact.as_ref().filter(|_| is_compared);
        Some(AccuracyReport {
            nearest: of(Filter::Nearest),
            split: of(Filter::Split),
            exact_cells: exact.map(|exact| exact.count),
        })
    }

    fn filter_report(&self, keys: &Keys) -> Option<FilterReport> {
        let built = self.built(keys)?;
        let levels = built.levels();
        let found = keys.get(Part::Comparison).and_then(|key| self.parts.comparisons.finished(key)?.found);
        Some(FilterReport {
            filter: built.masks.filter,
            kernel_ms: self.build_ms(keys),
            times: self.times.of(keys.get(Part::Payload)?.method()).unwrap_or_default(),
            voxels: built.masks.voxels.into(),
            leaves: built.counts.params.leaf_count.into(),
            nodes: levels.iter().map(|level| level.nodes).sum(),
            bytes: levels.iter().map(|level| level.bytes).sum(),
            holes: found.map(|counts| counts[0]),
            spill: found.map(|counts| counts[1]),
        })
    }
}

fn light_bytes_of(request: &Request, keys: &Keys, params: &OctreeParams) -> u64 {
    if keys.get(Part::Light).is_none() {
        return 0;
    }
    let asked = &request.shown().asked;
    // Direct irradiance, that of bounces, and emission.
    let emits = keys.get(Part::Emission).is_some();
    let a_leaf = 1 + u64::from(calls_for(Pass::Bounces, asked)) + u64::from(emits);
    light_bytes(params, request.settings().lighting.opacity.is_directional())
        + IRRADIANCE_BYTES * u64::from(params.leaf_count) * a_leaf
}
