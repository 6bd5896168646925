//! Drives the transformation the way an engine does: parts with caches and matrices become world
//! voxels in pages. World voxels can be given as well, for the stages behind.

use glam::{DAffine3, DVec3};
use octolume::data::matrix::Matrix3x4;
use octolume::data::packing::{pack_normal, pack_position, unpack_position};
use octolume::data::pages::{ListedVoxels, Pages, SegmentOrder, WorkItem, WorkList, WorkPart};
use octolume::data::voxel_cache::{CacheVoxel, VoxelJoints};
use octolume::gpu::{Gpu, GpuBuffer, Job, Recorder};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::transform::rigid_ref::{pack_q, unpack_q};
use octolume::stages::transform::{MovingVoxels, PartRecord, rigid, skinned};
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

/// World voxels on the GPU with the work list that walks them.
pub struct World {
    pub listed: ListedVoxels,
    pub list: WorkList,
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

/// `color` in codes.
pub fn cache_voxel(cell: [u32; 3], normal: DVec3, color: [u8; 3]) -> CacheVoxel {
    CacheVoxel {
        position: pack_position(cell),
        normal: pack_normal(normal),
        albedo: u32::from_le_bytes([color[0], color[1], color[2], 255]),
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
    [q[0], q[1], n[0] | n[1] << 10 | n[2] << 20, a[0] | a[1] << 8 | a[2] << 16 | fragment.coverage << 24]
}

/// A world voxel as later stages see it; `None`: it misses the grid.
pub fn fragment(words: [u32; 4]) -> Option<Fragment> {
    (words[0] != u32::MAX).then(|| Fragment {
        q: unpack_q([words[0], words[1]]),
        normal: [0, 10, 20].map(|shift| words[2] >> shift & 0x3ff),
        albedo: [0, 8, 16].map(|shift| words[3] >> shift & 0xff),
        coverage: words[3] >> 24,
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

fn listed(gpu: &Gpu, list: &WorkList, parts: &[PartRecord], world_voxels: GpuBuffer) -> ListedVoxels {
    ListedVoxels {
        work_items: upload(gpu, "work items", &list.items),
        work_hints: upload(gpu, "work hints", &list.hints),
        parts: upload(gpu, "parts", parts),
        world_voxels,
        threads: list.threads,
    }
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
            uploaded.push(PartRecord {
                origin: part.origin,
                first_matrix: matrices.len() as u32,
                joints_skew: if part.joints.is_empty() { 0 } else { first_voxel - joints.len() as u32 },
                object: part.object,
                ..PartRecord::default()
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
        let slots = buffer(gpu, "world voxels", 4 * u64::from(pages.slot_count()));
        let moving = MovingVoxels {
            listed: listed(gpu, &list, &uploaded, slots),
            matrices: upload(gpu, "matrices", &matrices),
            cache_voxels: upload(gpu, "cache voxels", &voxels),
            cache_joints: (!joints.is_empty()).then(|| upload(gpu, "cache joints", &joints)),
            rigid_threads,
        };
        run(gpu, |frame| {
            rigid::record(gpu, frame, &moving, 1 << depth);
            if let Some(joints) = &moving.cache_joints {
                skinned::record(gpu, frame, &moving, joints, 1 << depth);
            }
        });
        Self { listed: moving.listed, list }
    }

    /// World voxels as given, in thread order.
    pub fn given(gpu: &Gpu, voxels: &[[u32; 4]]) -> Self {
        let mut pages = Pages::new(SegmentOrder::default());
        pages.enter(0, voxels.len() as u32);
        let list =
            WorkList::new(&pages, [WorkPart { part: 0, object: 0, first_voxel: 0, voxels: voxels.len() as u32 }]);
        let slots = upload(gpu, "world voxels", voxels);
        Self { listed: listed(gpu, &list, &[PartRecord::default()], slots), list }
    }

    /// What lies in the voxels' slots, in thread order.
    pub fn read(&self, gpu: &Gpu) -> Vec<[u32; 4]> {
        let slots: Vec<[u32; 4]> = read(gpu, &self.listed.world_voxels, self.listed.world_voxels.bytes() / 16);
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
}
