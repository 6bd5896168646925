//! What the last build made, in numbers.

use super::super::Engine;
use super::super::parts::exact::Comparison;
use super::super::parts::masks::Masks;
use super::super::parts::posed_voxels::PosedVoxels;
use super::super::reports::{AccuracyReport, FilterReport, LevelReport, OctreeReport};
use super::super::request::Request;
use super::Built;
use crate::data::light::{IRRADIANCE_BYTES, light_bytes};
use crate::data::octree::{FULL_WEIGHT, OctreeParams, PointerLayout};
use crate::plan::{Keys, Part, Pass, calls_for};
use crate::settings::Filter;

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
        let voxels = self.world_voxels(keys, built.masks);
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

    /// That the octree is built from.
    fn world_voxels(&self, keys: &Keys, masks: &Masks) -> u64 {
        let Some(posed) = self.parts.finished::<PosedVoxels>(keys) else { return masks.voxels.into() };
        let moved = masks.voxels - posed.room().voxels;
        posed.counts.map_or(masks.voxels, |counts| moved + counts.voxels).into()
    }

    fn filter_report(&self, keys: &Keys) -> Option<FilterReport> {
        let built = self.built(keys)?;
        let levels = built.levels();
        let found = self.parts.finished::<Comparison>(keys).and_then(|comparison| comparison.found);
        Some(FilterReport {
            filter: built.masks.filter,
            kernel_ms: self.build_ms(keys),
            times: self.times.of(keys.get(Part::Payload)?.method()).unwrap_or_default(),
            voxels: self.world_voxels(keys, built.masks),
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
    light_bytes(params, request.settings().method.lighting.opacity.is_directional())
        + IRRADIANCE_BYTES * u64::from(params.leaf_count) * a_leaf
}
