//! Builds, fills and averages an octree from world voxels the way an engine does, and reads
//! everything back.

use octolume::data::octree::{
    MaskBuffers, OctreeParams, OctreeRef, OctreeSizes, PayloadBuffers, Slot, TopologyBuffers, mask_words,
};
use octolume::data::pages::ListedVoxels;
use octolume::gpu::{Gpu, GpuBuffer, Recorder};
use octolume::settings::Filter;
use octolume::stages::averaging::average;
use octolume::stages::build::scan::{self, Scanned};
use octolume::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED, COUNTERS, LevelParams, emit, mark, reduce, size};
use octolume::stages::fill::{count, gather, gather_heavy, number_objects, place};

use crate::stage_buffers::{OutBuffers, dirty, heavy_words};
use crate::stage_rig::{World, read, run};

#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub depth: u32,
    pub dense_level: u32,
    pub filter: Filter,
    /// Off only to show that tests see it.
    pub dummies: bool,
}

impl Shape {
    pub fn new(depth: u32, dense_level: u32, filter: Filter) -> Self {
        Self { depth, dense_level, filter, dummies: true }
    }
}

/// What a build is in, and what others add to it.
#[derive(Debug, Default)]
pub struct OctreeBuffers {
    /// Of the last build.
    pub sizes: Option<OctreeSizes>,
    pub masks: MaskBuffers,
    pub topology: TopologyBuffers,
    pub payload: PayloadBuffers,
    pub leaf_objects: Slot,
    pub neighbours: Slot,
    pub node_neighbours: Slot,
}

impl OctreeBuffers {
    pub fn octree(&self) -> OctreeRef<'_> {
        let sizes = self.sizes.as_ref().expect("built");
        OctreeRef { sizes, masks: &self.masks, topology: &self.topology, payload: &self.payload }
    }
}

/// Everything that a build leaves, as it lies in the buffers.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    pub params: OctreeParams,
    pub leaf_bits: Vec<u32>,
    pub occupied: Vec<u32>,
    pub blocks: Vec<u32>,
    pub ranks: Vec<u32>,
    pub clipped: u64,
    /// Occupied nodes of levels 0 … depth.
    pub occupied_counts: Vec<u64>,
    pub block_keys: Vec<u32>,
    pub first_child: Vec<u32>,
    pub block_counts: Vec<[u32; 2]>,
    pub block_starts: Vec<[u32; 2]>,
    pub places: Vec<[u32; 2]>,
    pub sorted_voxels: Vec<[u32; 4]>,
    pub leaves: Vec<[u32; 3]>,
    pub nodes: Vec<[u32; 4]>,
    pub heavy_blocks: Vec<u32>,
    /// A word an occupied leaf, see `fill/number_objects.wgsl`.
    pub leaf_objects: Vec<u32>,
}

impl World {
    /// Builds, fills and averages the octree in new buffers.
    pub fn build(&self, gpu: &Gpu, shape: &Shape) -> Built {
        self.build_in(gpu, shape, &mut OctreeBuffers::default())
    }

    /// The same in buffers that may hold an earlier build.
    pub fn build_in(&self, gpu: &Gpu, shape: &Shape, buffers: &mut OctreeBuffers) -> Built {
        let known = OctreeParams::new(shape.depth, shape.dense_level);
        let masks = Masked::new(gpu, &known, buffers);
        run(gpu, |frame| masks.record(gpu, frame, &self.listed, shape));
        let sizes = OctreeSizes::upload(gpu, &masks.counted(gpu)).expect("small");
        let out = OutBuffers::new(gpu, &sizes, self.list.threads, buffers);
        run(gpu, |frame| self.record_fill(gpu, frame, shape, (&sizes, &masks), &out, buffers));
        buffers.sizes = Some(sizes.clone());
        masks.built(gpu, sizes.params, &out, self.list.threads.into())
    }

    /// The same in one recording: the CPU knows no sizes, only what there is room for.
    pub fn build_within(&self, gpu: &Gpu, shape: &Shape, room: &OctreeParams, buffers: &mut OctreeBuffers) -> Built {
        let masks = Masked::new(gpu, room, buffers);
        let sizes = masks.sizes.clone();
        let out = OutBuffers::new(gpu, &sizes, self.list.threads, buffers);
        run(gpu, |frame| {
            masks.record(gpu, frame, &self.listed, shape);
            size::record(gpu, frame, &sizes, &buffers.masks).expect("masks are made");
            self.record_fill(gpu, frame, shape, (&sizes, &masks), &out, buffers);
        });
        let found: Vec<OctreeParams> = read(gpu, &sizes.buffer, 1);
        buffers.sizes = Some(sizes);
        masks.built(gpu, found[0], &out, self.list.threads.into())
    }

    fn record_fill(
        &self,
        gpu: &Gpu,
        frame: &mut Recorder,
        shape: &Shape,
        (sizes, masks): (&OctreeSizes, &Masked),
        out: &OutBuffers,
        buffers: &OctreeBuffers,
    ) {
        let (listed, fill, emitted) = (&self.listed, &out.fill, &out.emitted);
        emit::record_start(frame, sizes, emitted);
        for level in shape.dense_level..shape.depth {
            let look_up = (&masks.reduced.blocks, &masks.ranks, &masks.reduced.leaf_bits);
            emit::record(gpu, frame, sizes, look_up, emitted, level);
        }
        fill.record_start(frame, sizes, &buffers.topology).expect("the topology is made");
        count::record(gpu, frame, listed, sizes, shape.filter, fill);
        let pairs = (Scanned::Pairs, sizes.params.leaf_block_count);
        let scanned = scan::record(gpu, frame, pairs, &fill.block_counts, &fill.block_starts, &mut Vec::new());
        scanned.unwrap_or_else(|error| panic!("{error}"));
        place::record(gpu, frame, listed, fill);
        gather::record(gpu, frame, listed, sizes, shape.filter, fill);
        gather_heavy::record(gpu, frame, sizes, shape.filter, fill);
        for level in (0..shape.depth - 1).rev() {
            average::record(gpu, frame, sizes, &emitted.first_child, &fill.nodes, level);
        }
        let bits_and_objects = (&masks.reduced.leaf_bits, &out.leaf_objects);
        number_objects::record(gpu, frame, listed, (sizes, shape.filter), fill, bits_and_objects);
    }
}

/// Mask buffers: sizes known before anything is built.
struct Masked {
    sizes: OctreeSizes,
    reduced: reduce::Masks,
    ranks: GpuBuffer,
}

impl Masked {
    fn new(gpu: &Gpu, params: &OctreeParams, buffers: &mut OctreeBuffers) -> Self {
        let b = &mut buffers.masks;
        let reduced = reduce::Masks {
            leaf_bits: dirty(gpu, &mut b.leaf_bits, "leaf bits", mask_words(params.depth).into()),
            occupied: dirty(gpu, &mut b.occupied, "occupied", params.occupied_words().into()),
            blocks: dirty(gpu, &mut b.blocks, "blocks", params.blocks_words().into()),
            counters: dirty(gpu, &mut b.counters, "counters", 2 * u64::from(COUNTERS)),
        };
        let ranks = dirty(gpu, &mut b.ranks, "ranks", u64::from(params.blocks_words()) + 1);
        Self { sizes: OctreeSizes::upload(gpu, params).expect("small"), reduced, ranks }
    }

    fn record(&self, gpu: &Gpu, frame: &mut Recorder, listed: &ListedVoxels, shape: &Shape) {
        let (sizes, masks) = (&self.sizes, &self.reduced);
        mark::record(gpu, frame, listed, sizes, shape.filter, &masks.leaf_bits, &masks.counters);
        for level in (0..shape.depth).rev() {
            if shape.dummies {
                reduce::record(gpu, frame, sizes, masks, level);
            } else {
                reduce_without_dummies(gpu, frame, sizes, masks, level);
            }
        }
        let bits = (Scanned::Bits, sizes.params.blocks_words());
        let scanned = scan::record(gpu, frame, bits, &masks.blocks, &self.ranks, &mut Vec::<Slot>::new());
        scanned.unwrap_or_else(|error| panic!("{error}"));
    }

    /// The sizes that the scan has found.
    fn counted(&self, gpu: &Gpu) -> OctreeParams {
        let params = &self.sizes.params;
        let ranks: Vec<u32> = read(gpu, &self.ranks, u64::from(params.blocks_words()) + 1);
        let words = (params.dense_level..params.depth).map(|level| params.levels[level as usize].blocks_word);
        let firsts: Vec<u32> = words.chain([params.blocks_words()]).map(|word| ranks[word as usize]).collect();
        params.with_counts(&firsts, self.counters(gpu)[(COUNTER_OCCUPIED + params.depth) as usize] as u32)
    }

    fn counters(&self, gpu: &Gpu) -> Vec<u64> {
        read(gpu, &self.reduced.counters, COUNTERS.into())
    }

    fn built(&self, gpu: &Gpu, params: OctreeParams, out: &OutBuffers, voxels: u64) -> Built {
        let (masks, fill) = (&self.reduced, &out.fill);
        let counters = self.counters(gpu);
        let leaf_blocks = u64::from(params.leaf_block_count);
        let heavy: Vec<u32> = read(gpu, &fill.heavy_blocks, heavy_words(voxels));
        Built {
            params,
            leaf_bits: read(gpu, &masks.leaf_bits, mask_words(params.depth).into()),
            occupied: read(gpu, &masks.occupied, params.occupied_words().into()),
            blocks: read(gpu, &masks.blocks, params.blocks_words().into()),
            ranks: read(gpu, &self.ranks, u64::from(params.blocks_words()) + 1),
            clipped: counters[COUNTER_CLIPPED as usize],
            occupied_counts: counters[COUNTER_OCCUPIED as usize..][..=params.depth as usize].to_vec(),
            block_keys: read(gpu, &fill.block_keys, params.block_count.into()),
            first_child: read(gpu, &out.emitted.first_child, params.inner_node_count.into()),
            block_counts: read(gpu, &fill.block_counts, leaf_blocks),
            block_starts: read(gpu, &fill.block_starts, leaf_blocks + 1),
            places: read(gpu, &fill.places, voxels),
            sorted_voxels: read(gpu, &fill.sorted_voxels, voxels),
            leaves: read(gpu, &fill.leaves, params.leaf_count.into()),
            nodes: read(gpu, &fill.nodes, params.inner_node_count.into()),
            heavy_blocks: heavy[1..1 + heavy[0] as usize].to_vec(),
            leaf_objects: read(gpu, &out.leaf_objects, params.leaf_count.into()),
        }
    }
}

/// The mutation of `reduce`: no backward neighbours.
fn reduce_without_dummies(gpu: &Gpu, frame: &mut Recorder, sizes: &OctreeSizes, masks: &reduce::Masks, level: u32) {
    frame
        .pass(&gpu.kernel("build/reduce.wgsl", &[("DUMMIES", 0.0)]))
        .bind("octree", &sizes.buffer)
        .uniform("params", &LevelParams { level })
        .bind("leaf_bits", &masks.leaf_bits)
        .bind("occupied", &masks.occupied)
        .bind("blocks", &masks.blocks)
        .bind("counters", &masks.counters)
        .dispatch(mask_words(level).into());
}
