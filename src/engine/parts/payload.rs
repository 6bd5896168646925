//! What leaves and nodes hold: the voxels are sorted by leaf block, gathered into exact sums, and averaged to the root
//! (sections 4.3 and 4.4).

use super::masks::{Masks, sizes};
use super::topology::Topology;
use super::world_voxels::world_voxels;
use super::{Made, Making, Parts, Read};
use crate::data::octree::{OctreeRef, PayloadBuffers};
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::settings::Filter;
use crate::stages::averaging::average;
use crate::stages::build::scan::{self, Scanned};
use crate::stages::fill::{Filling, count, gather, gather_heavy, place};

#[derive(Debug, Default)]
pub struct Payload {
    pub buffers: PayloadBuffers,
    /// Sum of all leaves' occupancy, 2^24 a full leaf: the root's.
    pub occupancy: u64,
}

impl Made for Payload {
    const PART: Part = Part::Payload;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let gpu = making.gpu;
        let voxels = world_voxels(making, parts)?;
        let masks = parts.made::<Masks>(making.keys)?;
        let topology = parts.made::<Topology>(making.keys)?;
        let (sizes, filter) = (sizes(making, parts)?, masks.filter);
        let (masks, topology) = (&masks.buffers, &topology.buffers);
        let fill = Filling::new(gpu, sizes, masks, topology, &mut self.buffers, voxels.threads)?;
        making.begin(frame, Pass::SortVoxels);
        fill.record_start(frame, sizes, topology)?;
        count::record(gpu, frame, &voxels, sizes, filter, &fill);
        let pairs = (Scanned::Pairs, sizes.params.leaf_block_count);
        scan::record(gpu, frame, pairs, &fill.block_counts, &fill.block_starts, &mut self.buffers.scan_sums)?;
        place::record(gpu, frame, &voxels, &fill);
        making.begin(frame, if filter == Filter::Split { Pass::GatherSplit } else { Pass::GatherNearest });
        gather::record(gpu, frame, &voxels, sizes, filter, &fill);
        gather_heavy::record(gpu, frame, sizes, filter, &fill);
        making.begin(frame, Pass::AverageNodes);
        let first_child = topology.first_child.made("child pointers")?;
        for level in (0..sizes.params.depth - 1).rev() {
            average::record(gpu, frame, sizes, &first_child, &fill.nodes, level);
        }
        Ok(Some((fill.nodes, 0..8)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        self.occupancy = u64::from(words[0]) | u64::from(words[1]) << 32;
        Ok(())
    }
}

/// The method's octree as its readers bind it.
pub fn octree<'a>(making: &Making<'_>, parts: &'a Parts) -> Result<OctreeRef<'a>, EngineError> {
    Ok(OctreeRef {
        sizes: sizes(making, parts)?,
        masks: &parts.made::<Masks>(making.keys)?.buffers,
        topology: &parts.made::<Topology>(making.keys)?.buffers,
        payload: &parts.made::<Payload>(making.keys)?.buffers,
    })
}
