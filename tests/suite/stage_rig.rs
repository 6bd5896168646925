//! Drives the stages the way an engine does, from a cache or from world voxels to the averaged
//! octree, and reads everything back.

use glam::{DAffine3, DVec3};
use octolume::data::octree::{MAX_FRAGMENTS, OctreeBuffers, OctreeParams, Slot, mask_words};
use octolume::data::packing::{pack_normal, pack_position, pack_rgba8, unpack_position};
use octolume::data::pages::{Pages, SegmentOrder, WorkItem, WorkList, WorkPart};
use octolume::data::voxel_cache::{CacheVoxel, VoxelJoints};
use octolume::gpu::{Gpu, GpuBuffer, Job, Recorder};
use octolume::settings::Filter;
use octolume::stages::average::average;
use octolume::stages::build::scan::{self, Scanned};
use octolume::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED, COUNTERS, LevelParams, emit, mark, reduce};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::fill::{Filling, count, gather, gather_heavy, number_objects, place};
use octolume::stages::transform::rigid_ref::{pack_q, unpack_q};
use octolume::stages::transform::{Matrix3x4, MovingVoxels, Part, rigid, skinned};
use wgpu::BufferUsages;

/// A tile of an object: voxels, what moves them, and joints where it is skinned.
#[derive(Clone, Debug, Default)]
pub struct RigPart {
    pub object: u32,
    pub origin: [i32; 3],
    pub voxels: Vec<CacheVoxel>,
    /// As many as voxels, or none: rigid.
    pub joints: Vec<VoxelJoints>,
    pub matrices: Vec<Matrix3x4>,
}

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

/// World voxels on the GPU with the work list that walks them.
pub struct World {
    pub moving: MovingVoxels,
    pub list: WorkList,
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

/// `grid_from_cache` as uploaded: the anchor of a voxel (its centre: ½) folded in, then f32.
pub fn matrix(grid_from_cache: &DAffine3, anchor: f64) -> Matrix3x4 {
    let m = *grid_from_cache * DAffine3::from_translation(DVec3::splat(anchor));
    let row = |axis: usize| {
        let linear = m.matrix3.row(axis);
        [linear.x as f32, linear.y as f32, linear.z as f32, m.translation[axis] as f32]
    };
    Matrix3x4 { rows: [row(0), row(1), row(2)] }
}

pub fn cache_voxel(cell: [u32; 3], normal: DVec3, albedo: [u8; 3]) -> CacheVoxel {
    let rgb = albedo.map(|byte| f64::from(byte) / 255.0);
    CacheVoxel {
        position: pack_position(cell),
        normal: pack_normal(normal),
        albedo: pack_rgba8([rgb[0], rgb[1], rgb[2], 1.0]),
        surface: 0,
    }
}

/// The lattice cell of a part's voxel.
pub fn lattice_cell(part: &RigPart, voxel: usize) -> [i32; 3] {
    let position = unpack_position(part.voxels[voxel].position);
    [0, 1, 2].map(|axis| part.origin[axis] + position[axis] as i32)
}

/// The words of a world voxel.
pub fn world_voxel(fragment: &Fragment) -> [u32; 4] {
    let q = pack_q(fragment.q);
    let [n, a] = [fragment.normal, fragment.albedo];
    [q[0], q[1], n[0] | n[1] << 10 | n[2] << 20, a[0] | a[1] << 8 | a[2] << 16 | 0xff00_0000]
}

/// A world voxel as later stages see it; `None`: it misses the grid.
pub fn fragment(words: [u32; 4]) -> Option<Fragment> {
    (words[0] != u32::MAX).then(|| Fragment {
        q: unpack_q([words[0], words[1]]),
        normal: [0, 10, 20].map(|shift| words[2] >> shift & 0x3ff),
        albedo: [0, 8, 16].map(|shift| words[3] >> shift & 0xff),
    })
}

pub fn run(gpu: &Gpu, record: impl FnOnce(&mut Recorder)) {
    let mut frame = Recorder::default();
    record(&mut frame);
    Job::new(frame).run_to_end(gpu).unwrap_or_else(|error| panic!("{error}"));
}

pub fn buffer(gpu: &Gpu, label: &str, words: u64) -> GpuBuffer {
    gpu.buffer(label, 4 * words, BufferUsages::empty()).unwrap_or_else(|error| panic!("{error}"))
}

pub fn upload<T: bytemuck::Pod>(gpu: &Gpu, label: &str, data: &[T]) -> GpuBuffer {
    gpu.upload(label, data).unwrap_or_else(|error| panic!("{error}"))
}

pub fn read<T: bytemuck::Pod>(gpu: &Gpu, buffer: &GpuBuffer, count: u64) -> Vec<T> {
    gpu.read(buffer, 0..count * size_of::<T>() as u64).unwrap_or_else(|error| panic!("{error}"))
}

impl World {
    /// Moves the parts: their segments in `order`, rigid ones first in the work list.
    pub fn moved(gpu: &Gpu, parts: &[RigPart], depth: u32, order: SegmentOrder) -> Self {
        let mut pages = Pages::new(order);
        let (mut voxels, mut joints) = (Vec::new(), Vec::<VoxelJoints>::new());
        let (mut matrices, mut uploaded) = (Vec::new(), Vec::new());
        let mut numbered = Vec::new();
        for (part, number) in parts.iter().zip(0..) {
            let (first_voxel, count) = (voxels.len() as u32, part.voxels.len() as u32);
            pages.enter(number, count);
            uploaded.push(Part {
                origin: part.origin,
                first_matrix: matrices.len() as u32,
                joints_skew: if part.joints.is_empty() { 0 } else { first_voxel - joints.len() as u32 },
                object: part.object,
                ..Part::default()
            });
            voxels.extend_from_slice(&part.voxels);
            joints.extend_from_slice(&part.joints);
            matrices.extend_from_slice(&part.matrices);
            numbered.push(WorkPart { part: number, object: part.object, first_voxel, voxels: count });
        }
        pages.validate().expect("pages");
        let is_rigid = |work: &WorkPart| parts[work.part as usize].joints.is_empty();
        let (rigid_parts, skinned_parts): (Vec<_>, Vec<_>) = numbered.into_iter().partition(is_rigid);
        let rigid_threads = rigid_parts.iter().map(|work| work.voxels).sum();
        let list = WorkList::new(&pages, rigid_parts.into_iter().chain(skinned_parts));
        let moving = MovingVoxels {
            work_items: upload(gpu, "work items", &list.items),
            work_hints: upload(gpu, "work hints", &list.hints),
            parts: upload(gpu, "parts", &uploaded),
            matrices: upload(gpu, "matrices", &matrices),
            cache_voxels: upload(gpu, "cache voxels", &voxels),
            cache_joints: (!joints.is_empty()).then(|| upload(gpu, "cache joints", &joints)),
            world_voxels: buffer(gpu, "world voxels", 4 * u64::from(pages.slot_count())),
            rigid_threads,
            skinned_threads: list.threads - rigid_threads,
        };
        run(gpu, |frame| {
            rigid::record(gpu, frame, &moving, 1 << depth);
            if let Some(joints) = &moving.cache_joints {
                skinned::record(gpu, frame, &moving, joints, 1 << depth);
            }
        });
        Self { moving, list }
    }

    /// World voxels as given, in thread order.
    pub fn given(gpu: &Gpu, voxels: &[[u32; 4]]) -> Self {
        let mut pages = Pages::new(SegmentOrder::default());
        pages.enter(0, voxels.len() as u32);
        let list =
            WorkList::new(&pages, [WorkPart { part: 0, object: 0, first_voxel: 0, voxels: voxels.len() as u32 }]);
        let moving = MovingVoxels {
            work_items: upload(gpu, "work items", &list.items),
            work_hints: upload(gpu, "work hints", &list.hints),
            parts: upload(gpu, "parts", &[Part::default()]),
            matrices: upload(gpu, "matrices", &[Matrix3x4::default()]),
            cache_voxels: upload(gpu, "cache voxels", &[[0_u32; 4]]),
            cache_joints: None,
            world_voxels: upload(gpu, "world voxels", voxels),
            rigid_threads: list.threads,
            skinned_threads: 0,
        };
        Self { moving, list }
    }

    /// What lies in the voxels' slots, in thread order.
    pub fn read(&self, gpu: &Gpu) -> Vec<[u32; 4]> {
        let slots: Vec<[u32; 4]> = read(gpu, &self.moving.world_voxels, self.moving.world_voxels.bytes() / 16);
        let run = |pair: &[WorkItem]| {
            let threads = pair[1].first_thread.min(self.list.threads) - pair[0].first_thread;
            let first = pair[0].first_slot as usize;
            slots[first..first + threads as usize].to_vec()
        };
        self.list.items.windows(2).flat_map(run).collect()
    }

    /// As [`Self::read`], decoded.
    pub fn fragments(&self, gpu: &Gpu) -> Vec<Option<Fragment>> {
        self.read(gpu).into_iter().map(fragment).collect()
    }

    /// Builds, fills and averages the octree in new buffers.
    pub fn build(&self, gpu: &Gpu, shape: &Shape) -> Built {
        self.build_in(gpu, shape, &mut OctreeBuffers::default())
    }

    /// The same in buffers that may hold an earlier build.
    pub fn build_in(&self, gpu: &Gpu, shape: &Shape, buffers: &mut OctreeBuffers) -> Built {
        let masks = Masked::new(gpu, &OctreeParams::new(shape.depth, shape.dense_level), buffers);
        masks.record(gpu, &self.moving, shape);
        let params = masks.counted(gpu);
        let filling = masks.filling(gpu, &params, u64::from(self.list.threads), buffers);
        self.fill(gpu, shape, &params, &masks, &filling);
        masks.built(gpu, params, &filling, u64::from(self.list.threads))
    }

    fn fill(&self, gpu: &Gpu, shape: &Shape, params: &OctreeParams, masks: &Masked, filling: &OutBuffers) {
        let out = &filling.emitted;
        run(gpu, |frame| {
            for buffer in [&out.first_child, &filling.fill.nodes, &filling.fill.heavy_blocks] {
                frame.clear(buffer);
            }
            for level in shape.dense_level..shape.depth {
                let look_up = (&masks.reduced.blocks, &masks.ranks, &masks.reduced.leaf_bits);
                emit::record(gpu, frame, params, look_up, out, level);
            }
            let (moving, fill) = (&self.moving, &filling.fill);
            count::record(gpu, frame, moving, params, shape.filter, fill);
            let pairs = (Scanned::Pairs, params.leaf_block_count);
            let scanned = scan::record(gpu, frame, pairs, &out.block_counts, &fill.block_starts, &mut Vec::new());
            scanned.unwrap_or_else(|error| panic!("{error}"));
            place::record(gpu, frame, moving, fill);
            gather::record(gpu, frame, params, shape.filter, fill);
            gather_heavy::record(gpu, frame, params, shape.filter, fill);
            for level in (0..shape.depth - 1).rev() {
                average::record(gpu, frame, params, &out.first_child, &fill.nodes, level);
            }
            let bits_and_objects = (&masks.reduced.leaf_bits, &filling.leaf_objects);
            number_objects::record(gpu, frame, moving, (params, shape.filter), fill, bits_and_objects);
        });
    }
}

/// A new buffer is full of ones, so that whatever is not written shows; an old one keeps its contents.
fn dirty(gpu: &Gpu, slot: &mut Slot, label: &str, words: u64) -> GpuBuffer {
    let is_new = slot.get().is_none_or(|buffer| buffer.bytes() < 4 * words);
    let buffer = slot.ensure(gpu, label, 4 * words).unwrap_or_else(|error| panic!("{error}"));
    if is_new {
        gpu.write(&buffer, 0, &vec![0xff; buffer.bytes() as usize]).unwrap_or_else(|error| panic!("{error}"));
    }
    buffer
}

/// Mask buffers: sizes known before anything is built.
struct Masked {
    params: OctreeParams,
    reduced: reduce::Masks,
    ranks: GpuBuffer,
}

struct OutBuffers {
    emitted: emit::Emitted,
    fill: Filling,
    leaf_objects: GpuBuffer,
}

impl Masked {
    fn new(gpu: &Gpu, params: &OctreeParams, buffers: &mut OctreeBuffers) -> Self {
        let reduced = reduce::Masks {
            leaf_bits: dirty(gpu, &mut buffers.leaf_bits, "leaf bits", mask_words(params.depth).into()),
            occupied: dirty(gpu, &mut buffers.occupied, "occupied", params.occupied_words().into()),
            blocks: dirty(gpu, &mut buffers.blocks, "blocks", params.blocks_words().into()),
            counters: dirty(gpu, &mut buffers.counters, "counters", 2 * u64::from(COUNTERS)),
        };
        let ranks = dirty(gpu, &mut buffers.ranks, "ranks", u64::from(params.blocks_words()) + 1);
        Self { params: *params, reduced, ranks }
    }

    fn record(&self, gpu: &Gpu, moving: &MovingVoxels, shape: &Shape) {
        let (params, masks) = (&self.params, &self.reduced);
        run(gpu, |frame| {
            mark::record(gpu, frame, moving, params, shape.filter, &masks.leaf_bits, &masks.counters);
            for level in (0..shape.depth).rev() {
                if shape.dummies {
                    reduce::record(gpu, frame, params, masks, level);
                } else {
                    reduce_without_dummies(gpu, frame, params, masks, level);
                }
            }
            let bits = (Scanned::Bits, params.blocks_words());
            let scanned = scan::record(gpu, frame, bits, &masks.blocks, &self.ranks, &mut Vec::<Slot>::new());
            scanned.unwrap_or_else(|error| panic!("{error}"));
        });
    }

    /// The sizes that the scan has found.
    fn counted(&self, gpu: &Gpu) -> OctreeParams {
        let params = &self.params;
        let ranks: Vec<u32> = read(gpu, &self.ranks, u64::from(params.blocks_words()) + 1);
        let words = (params.dense_level..params.depth).map(|level| params.levels[level as usize].blocks_word);
        let firsts: Vec<u32> = words.chain([params.blocks_words()]).map(|word| ranks[word as usize]).collect();
        params.with_counts(&firsts, self.counters(gpu)[(COUNTER_OCCUPIED + params.depth) as usize] as u32)
    }

    fn counters(&self, gpu: &Gpu) -> Vec<u64> {
        read(gpu, &self.reduced.counters, COUNTERS.into())
    }

    fn filling(&self, gpu: &Gpu, params: &OctreeParams, voxels: u64, buffers: &mut OctreeBuffers) -> OutBuffers {
        let leaf_blocks = u64::from(params.leaf_block_count);
        let inner_nodes = u64::from(params.inner_node_count);
        let leaves = u64::from(params.leaf_count);
        let heavy_words = 2 + 8 * voxels / u64::from(MAX_FRAGMENTS);
        let emitted = emit::Emitted {
            block_keys: dirty(gpu, &mut buffers.block_keys, "block keys", params.block_count.into()),
            first_child: dirty(gpu, &mut buffers.first_child, "first child", inner_nodes),
            block_counts: dirty(gpu, &mut buffers.block_counts, "block counts", 2 * leaf_blocks),
        };
        let fill = Filling {
            blocks: self.reduced.blocks.clone(),
            ranks: self.ranks.clone(),
            block_keys: emitted.block_keys.clone(),
            block_counts: emitted.block_counts.clone(),
            block_starts: dirty(gpu, &mut buffers.block_starts, "block starts", 2 * (leaf_blocks + 1)),
            places: dirty(gpu, &mut buffers.places, "places", 2 * voxels),
            sorted_voxels: dirty(gpu, &mut buffers.sorted_voxels, "sorted voxels", 4 * voxels),
            leaves: dirty(gpu, &mut buffers.leaves, "leaves", 3 * leaves),
            nodes: dirty(gpu, &mut buffers.nodes, "nodes", 4 * inner_nodes),
            heavy_blocks: dirty(gpu, &mut buffers.heavy_blocks, "heavy blocks", heavy_words),
        };
        let leaf_objects = dirty(gpu, &mut buffers.leaf_objects, "leaf objects", leaves);
        OutBuffers { emitted, fill, leaf_objects }
    }

    fn built(&self, gpu: &Gpu, params: OctreeParams, out: &OutBuffers, voxels: u64) -> Built {
        let (masks, fill) = (&self.reduced, &out.fill);
        let counters = self.counters(gpu);
        let leaf_blocks = u64::from(params.leaf_block_count);
        let heavy: Vec<u32> = read(gpu, &fill.heavy_blocks, 2 + 8 * voxels / u64::from(MAX_FRAGMENTS));
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
fn reduce_without_dummies(gpu: &Gpu, frame: &mut Recorder, params: &OctreeParams, masks: &reduce::Masks, level: u32) {
    frame
        .pass(&gpu.kernel("build/reduce.wgsl", &[("DUMMIES", 0.0)]))
        .uniform("octree", params)
        .uniform("params", &LevelParams { level })
        .bind("leaf_bits", &masks.leaf_bits)
        .bind("occupied", &masks.occupied)
        .bind("blocks", &masks.blocks)
        .bind("counters", &masks.counters)
        .dispatch(mask_words(level).into());
}
