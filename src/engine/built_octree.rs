//! One octree from mark to root: what is recorded before its sizes are known, and after.

use crate::data::octree::{
    MaskBuffers, OctreeParams, OctreeRef, OctreeSizes, PayloadBuffers, PointerLayout, Slot, TopologyBuffers,
};
use crate::gpu::{Gpu, GpuBuffer, GpuError, KernelTiming, Recorder};
use crate::settings::{Filter, Lookup};
use crate::stages::averaging::average;
use crate::stages::build::emit::Emitted;
use crate::stages::build::link::Linked;
use crate::stages::build::reduce::Masks;
use crate::stages::build::scan::{self, Scanned};
use crate::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED, COUNTERS, emit, mark, reduce};
use crate::stages::fill::{Filling, count, gather, gather_heavy, number_objects, place};
use crate::stages::sample::pointer_layout;
use crate::stages::transform::MovingVoxels;

#[derive(Debug, Default)]
pub struct OctreeBuffers {
    pub masks: MaskBuffers,
    pub topology: TopologyBuffers,
    pub payload: PayloadBuffers,
    pub leaf_objects: Slot,
    pub neighbours: Slot,
    pub node_neighbours: Slot,
}

/// An octree and what was learned while building it.
#[derive(Debug, Default)]
pub struct BuiltOctree {
    pub params: OctreeParams,
    pub filter: Filter,
    pub buffers: OctreeBuffers,
    sized: Option<OctreeSizes>,
    /// First blocks of levels dense … depth−1, the total, then the 64-bit counters.
    sizes: Slot,
    /// Leaves that hold anything, per level from the root to the leaves.
    pub occupied: Vec<u32>,
    /// Split weight outside the grid, 2^24 a voxel.
    pub clipped_weight: u64,
    /// Sum of all leaves' occupancy, 2^24 a full leaf: the root's.
    pub occupancy: u64,
    pub timings: Vec<KernelTiming>,
}

impl BuiltOctree {
    /// Marks, reduces and scans: all that is possible before sizes are known.
    pub fn record_masks(
        &mut self,
        gpu: &Gpu,
        voxels: &MovingVoxels,
        (depth, dense_level, filter): (u32, u32, Filter),
    ) -> Result<Recorder, GpuError> {
        let mut frame = Recorder::default();
        self.params = OctreeParams::new(depth, dense_level);
        self.filter = filter;
        let octree = self.params;
        let sized = &*self.sized.insert(OctreeSizes::upload(gpu, &octree)?);
        let b = &mut self.buffers.masks;
        let masks = Masks {
            leaf_bits: b.leaf_bits.ensure(gpu, "leaf bits", (1_u64 << (3 * depth)) / 8)?,
            occupied: b.occupied.ensure(gpu, "occupied masks", 4 * u64::from(octree.occupied_words()))?,
            blocks: b.blocks.ensure(gpu, "block masks", 4 * u64::from(octree.blocks_words()))?,
            counters: b.counters.ensure(gpu, "counters", 8 * u64::from(COUNTERS))?,
        };
        mark::record(gpu, &mut frame, voxels, sized, filter, &masks.leaf_bits, &masks.counters);
        for level in (0..depth).rev() {
            reduce::record(gpu, &mut frame, sized, &masks, level);
        }
        let words = octree.blocks_words();
        let ranks = b.ranks.ensure(gpu, "block ranks", 4 * u64::from(words + 1))?;
        scan::record(gpu, &mut frame, (Scanned::Bits, words), &masks.blocks, &ranks, &mut b.scan_sums)?;
        let sizes = self.sizes.ensure(gpu, "octree sizes", Self::sizes_bytes(&octree))?;
        for (place, word) in Self::size_words(&octree).into_iter().enumerate() {
            frame.copy(&ranks, 4 * u64::from(word), &sizes, 4 * place as u64, 4);
        }
        let first_counter = 4 * u64::from(depth - dense_level + 1);
        frame.copy(&masks.counters, 0, &sizes, first_counter, masks.counters.bytes());
        Ok(frame)
    }

    /// Words of the ranks that say where each sparse level's blocks begin, and the total.
    fn size_words(octree: &OctreeParams) -> Vec<u32> {
        let levels = octree.dense_level..octree.depth;
        levels.map(|level| octree.levels[level as usize].blocks_word).chain([octree.blocks_words()]).collect()
    }

    fn sizes_bytes(octree: &OctreeParams) -> u64 {
        4 * u64::from(octree.depth - octree.dense_level + 1) + 8 * u64::from(COUNTERS)
    }

    /// The buffer of sizes, and how much of it the caller must bring back for [`Self::set_sizes`].
    pub fn sizes(&self) -> Option<(&GpuBuffer, u64)> {
        Some((self.sizes.get()?, Self::sizes_bytes(&self.params)))
    }

    pub fn set_sizes(&mut self, words: &[u32]) {
        let (first_blocks, counters) = words.split_at((self.params.depth - self.params.dense_level + 1) as usize);
        let counter =
            |index: u32| u64::from(counters[2 * index as usize]) | u64::from(counters[2 * index as usize + 1]) << 32;
        self.occupied = (0..=self.params.depth).map(|level| counter(COUNTER_OCCUPIED + level) as u32).collect();
        self.clipped_weight = counter(COUNTER_CLIPPED);
        let leaves = self.occupied[self.params.depth as usize];
        self.params = self.params.with_counts(first_blocks, leaves);
    }

    /// Emits the nodes, sorts and gathers the voxels, averages to the root.
    pub fn record_nodes(&mut self, gpu: &Gpu, voxels: &MovingVoxels) -> Result<Recorder, GpuError> {
        let mut frame = Recorder::default();
        let octree = &*self.sized.insert(OctreeSizes::upload(gpu, &self.params)?);
        let b = &mut self.buffers;
        let out = Emitted::new(gpu, octree, &mut b.topology)?;
        let fill = Filling::new(gpu, octree, &b.masks, &b.topology, &mut b.payload, voxels.threads())?;
        let leaf_bits = b.masks.leaf_bits.made("leaf bits")?;
        emit::record_start(&mut frame, octree, &out);
        for level in octree.params.dense_level..octree.params.depth {
            emit::record(gpu, &mut frame, octree, (&fill.blocks, &fill.ranks, &leaf_bits), &out, level);
        }
        fill.record_start(&mut frame, octree, &b.topology)?;
        count::record(gpu, &mut frame, voxels, octree, self.filter, &fill);
        let pairs = (Scanned::Pairs, octree.params.leaf_block_count);
        scan::record(gpu, &mut frame, pairs, &fill.block_counts, &fill.block_starts, &mut b.payload.scan_sums)?;
        place::record(gpu, &mut frame, voxels, &fill);
        gather::record(gpu, &mut frame, voxels, octree, self.filter, &fill);
        gather_heavy::record(gpu, &mut frame, octree, self.filter, &fill);
        for level in (0..octree.params.depth - 1).rev() {
            average::record(gpu, &mut frame, octree, &out.first_child, &fill.nodes, level);
        }
        Ok(frame)
    }

    pub fn record_object_numbers(&mut self, gpu: &Gpu, voxels: &MovingVoxels) -> Result<Recorder, GpuError> {
        let mut frame = Recorder::default();
        let fill = self.filled()?;
        let leaf_bits = self.buffers.masks.leaf_bits.made("leaf bits")?;
        let objects = self.buffers.leaf_objects.ensure(gpu, "leaf objects", 4 * u64::from(self.params.leaf_count))?;
        let octree = (self.sizes_on_gpu()?, self.filter);
        number_objects::record(gpu, &mut frame, voxels, octree, &fill, (&leaf_bits, &objects));
        Ok(frame)
    }

    /// The buffers of a finished filling.
    pub fn filled(&self) -> Result<Filling, GpuError> {
        Filling::made(self.octree()?)
    }

    pub fn sizes_on_gpu(&self) -> Result<&OctreeSizes, GpuError> {
        self.sized.as_ref().ok_or_else(|| GpuError::Missing { label: "octree sizes".to_owned() })
    }

    pub fn octree(&self) -> Result<OctreeRef<'_>, GpuError> {
        let OctreeBuffers { masks, topology, payload, .. } = &self.buffers;
        Ok(OctreeRef { sizes: self.sizes_on_gpu()?, masks, topology, payload })
    }

    pub fn pointers(&self, lookup: Lookup) -> Option<&GpuBuffer> {
        match pointer_layout(lookup)? {
            PointerLayout::Blocks => self.buffers.neighbours.get(),
            PointerLayout::Nodes => self.buffers.node_neighbours.get(),
        }
    }

    /// What neighbour pointers are made from.
    pub fn linked(&self) -> Result<Linked, GpuError> {
        let OctreeBuffers { masks, topology, .. } = &self.buffers;
        Ok(Linked {
            blocks: masks.blocks.made("block masks")?,
            ranks: masks.ranks.made("block ranks")?,
            block_keys: topology.block_keys.made("block keys")?,
        })
    }

    /// Milliseconds of all its kernels.
    pub fn kernel_ms(&self) -> f64 {
        self.timings.iter().map(|timing| timing.ms).sum()
    }
}
