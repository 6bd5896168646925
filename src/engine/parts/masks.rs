//! Which leaves and blocks there are (section 4.3, without its locks): leaves are marked as bits in Morton order,
//! masks reduced level by level with the dilation that dummies need, and a scan turns them into ranks. What is behind
//! needs to know how many there are: as many as the last time and a share more, where there was one; the GPU counts,
//! and the true sizes come back later.

use super::world_voxels::world_voxels;
use super::{Made, Making, Parts, Read};
use crate::data::octree::{MaskBuffers, OctreeParams, OctreeSizes, Slot};
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::settings::Filter;
use crate::stages::build::scan::{self, Scanned};
use crate::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED, COUNTERS, mark, reduce, size};

#[derive(Debug, Default)]
pub struct Masks {
    pub buffers: MaskBuffers,
    pub filter: Filter,
    pub counts: Option<MaskCounts>,
    /// Moved voxels.
    pub voxels: u32,
    sizes: Option<OctreeSizes>,
    /// What the parts behind were made for; `None`: they wait for the counts.
    room: Option<OctreeParams>,
    read: Slot,
    params: Slot,
}

/// What the GPU has counted.
#[derive(Clone, Debug, Default)]
pub struct MaskCounts {
    pub params: OctreeParams,
    /// Nodes that hold anything, per level from the root to the leaves.
    pub occupied: Vec<u32>,
    /// Split weight outside the grid, 2^24 a voxel.
    pub clipped_weight: u64,
}

impl Masks {
    /// Exact, or with room for what is likely; `None` while nothing is known.
    pub fn sizes(&self) -> Option<&OctreeSizes> {
        self.sizes.as_ref().filter(|_| self.counts.is_some() || self.room.is_some())
    }

    /// There is more than the parts behind had room for.
    pub fn has_outgrown(&self) -> bool {
        matches!((&self.counts, &self.room), (Some(counts), Some(room)) if !counts.params.fits(room))
    }

    /// Words of the ranks that say where each sparse level's blocks begin, and the total.
    fn size_words(octree: &OctreeParams) -> Vec<u32> {
        let levels = octree.dense_level..octree.depth;
        levels.map(|level| octree.levels[level as usize].blocks_word).chain([octree.blocks_words()]).collect()
    }

    /// Brings ranks and counters together, to be read at once.
    fn record_read(&mut self, gpu: &Gpu, frame: &mut Recorder, octree: &OctreeParams) -> Result<Read, GpuError> {
        let words = Self::size_words(octree);
        let counters = self.buffers.counters.made("counters")?;
        let ranks = self.buffers.ranks.made("block ranks")?;
        let bytes = 4 * words.len() as u64 + 8 * u64::from(COUNTERS);
        let read = self.read.ensure(gpu, "octree sizes", bytes)?;
        for (place, word) in words.iter().enumerate() {
            frame.copy(&ranks, 4 * u64::from(*word), &read, 4 * place as u64, 4);
        }
        frame.copy(&counters, 0, &read, 4 * words.len() as u64, 8 * u64::from(COUNTERS));
        Ok((read, 0..bytes))
    }
}

impl Made for Masks {
    const PART: Part = Part::Masks;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, discretization) = (making.gpu, &making.method.settings().method.discretization);
        let voxels = world_voxels(making, parts)?;
        let (depth, filter) = (discretization.depth(), discretization.filter);
        let octree = OctreeParams::new(depth, discretization.deepest_dense());
        (self.filter, self.voxels, self.counts) = (filter, voxels.threads, None);
        self.room = parts.likely.sizes(making.own_key()?.method(), making.estimated_share);
        let sizes = OctreeSizes::write(gpu, &mut self.params, &octree)?;
        let masks = reduce::Masks::new(gpu, &octree, &mut self.buffers)?;
        making.begin(frame, Pass::MarkLeaves);
        mark::record(gpu, frame, &voxels, &sizes, filter, &masks.leaf_bits, &masks.counters);
        making.begin(frame, Pass::ReduceMasks);
        for level in (0..depth).rev() {
            reduce::record(gpu, frame, &sizes, &masks, level);
        }
        making.begin(frame, Pass::ScanBlocks);
        let words = octree.blocks_words();
        let ranks = self.buffers.ranks.ensure(gpu, "block ranks", 4 * u64::from(words + 1))?;
        scan::record(gpu, frame, (Scanned::Bits, words), &masks.blocks, &ranks, &mut self.buffers.scan_sums)?;
        making.begin(frame, Pass::CountNodes);
        let read = self.record_read(gpu, frame, &octree)?;
        // Where nothing is likely there is no room for anything, and what is behind waits.
        let sizes = OctreeSizes { params: self.room.unwrap_or(octree), ..sizes };
        size::record(gpu, frame, &sizes, &self.buffers)?;
        self.sizes = Some(sizes);
        Ok(Some(read))
    }

    fn received(&mut self, gpu: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        let Some(sizes) = &mut self.sizes else { return Ok(()) };
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        let octree = OctreeParams::new(sizes.params.depth, sizes.params.dense_level);
        let (first_blocks, counters) = words.split_at((octree.depth - octree.dense_level + 1) as usize);
        let counter =
            |index: u32| u64::from(counters[2 * index as usize]) | u64::from(counters[2 * index as usize + 1]) << 32;
        let occupied: Vec<u32> = (0..=octree.depth).map(|level| counter(COUNTER_OCCUPIED + level) as u32).collect();
        let params = octree.with_counts(first_blocks, occupied[octree.depth as usize]);
        sizes.params = params;
        // Where nothing was known, or too little room was made, the GPU does not know it yet.
        gpu.write(&sizes.buffer, 0, bytemuck::bytes_of(&params))?;
        self.counts = Some(MaskCounts { params, occupied, clipped_weight: counter(COUNTER_CLIPPED) });
        Ok(())
    }
}

/// Sizes of the method's octree: exact, or with room for what is likely.
pub fn sizes<'a>(making: &Making<'_>, parts: &'a Parts) -> Result<&'a OctreeSizes, EngineError> {
    let sizes = parts.made::<Masks>(making.keys)?.sizes();
    Ok(sizes.ok_or_else(|| GpuError::Missing { label: "octree sizes".to_owned() })?)
}
