//! The other discretizer: the posed triangles are voxelized every frame. There is room for as many fragments as the
//! last time and a share more, where there was one; what lacked room is made again.

use super::columns::Columns;
use super::materials::Materials;
use super::{Made, Making, Parts, Read};
use crate::data::fragments::{EMISSION_BYTES, FragmentCounts, FragmentRoom};
use crate::data::octree::Slot;
use crate::data::pages::{ListedVoxels, OBJECT_BY_VOXEL, WORK_HINT_THREADS, WORLD_VOXEL_BYTES, WorkItem};
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::transform::PartRecord;
use crate::stages::voxelize::{CellStore, CellStoreBuffers, cover, merge, shade};

/// World voxels of the posed triangles, one of each object in a cell.
#[derive(Debug, Default)]
pub struct PosedVoxels {
    store: CellStoreBuffers,
    room: FragmentRoom,
    pub counts: Option<FragmentCounts>,
    listed: Option<ListedVoxels>,
    work_items: Slot,
    work_hints: Slot,
    parts: Slot,
    world_voxels: Slot,
    voxel_count: Slot,
    emission: Slot,
}

impl PosedVoxels {
    pub fn listed(&self) -> Result<ListedVoxels, GpuError> {
        self.listed.clone().ok_or_else(|| GpuError::Missing { label: "posed voxels".to_owned() })
    }

    pub fn room(&self) -> FragmentRoom {
        self.room
    }

    pub fn emission(&self) -> Result<GpuBuffer, GpuError> {
        self.emission.made("emission of posed voxels")
    }

    /// There is more than there was room for.
    pub fn has_outgrown(&self) -> bool {
        let exceeds =
            |counts: &FragmentCounts| counts.fragments > self.room.fragments || counts.voxels > self.room.voxels;
        self.counts.as_ref().is_some_and(exceeds)
    }

    /// Of room; where fragments were lost, nobody knows how many voxels they are.
    pub fn needed(&self) -> Option<FragmentCounts> {
        let counts = self.counts?;
        let voxels = if counts.fragments > self.room.fragments { counts.fragments } else { counts.voxels };
        Some(FragmentCounts { voxels, ..counts })
    }

    /// One item of the work list, whose voxels have an object each.
    fn list(&mut self, gpu: &Gpu) -> Result<ListedVoxels, GpuError> {
        let (threads, hints) = (self.room.voxels, self.room.hints);
        let item = WorkItem { first_thread: 0, first_slot: 0, first_voxel: hints, part: 0, object: OBJECT_BY_VOXEL };
        let items = [item, WorkItem { first_thread: u32::MAX, ..item }];
        let work_items = self.work_items.ensure(gpu, "work items", size_of_val(&items) as u64)?;
        gpu.write(&work_items, 0, bytemuck::cast_slice(&items))?;
        let record = PartRecord { emission_skew: hints, ..PartRecord::default() };
        let parts = self.parts.ensure(gpu, "parts", size_of_val(&record) as u64)?;
        gpu.write(&parts, 0, bytemuck::bytes_of(&record))?;
        let work_hints = self.work_hints.ensure(gpu, "work hints", 4 * u64::from(hints + threads))?;
        let bytes = WORLD_VOXEL_BYTES * u64::from(threads);
        let world_voxels = self.world_voxels.ensure(gpu, "posed voxels", bytes)?;
        Ok(ListedVoxels { work_items, work_hints, parts, world_voxels, threads })
    }

    /// `likely` is what there was before. Else, columns have few more fragments than there are columns, and often far
    /// fewer: as much as an adapter has is tried before it is said that they do not fit.
    fn find_room(&mut self, columns: u32, likely: Option<FragmentCounts>, most: u32) {
        let tried = columns.min(most);
        let [fragments, voxels] = likely.map_or([tried; 2], |likely| [likely.fragments, likely.voxels]);
        let hints = voxels.div_ceil(WORK_HINT_THREADS);
        self.room = FragmentRoom { fragments, voxels, hints, bucket_bits: 0 };
    }
}

/// That a buffer holds.
fn most_fragments(gpu: &Gpu, emits: bool) -> u32 {
    (gpu.limits.max_storage_buffer_binding_size / CellStore::bytes_of_fragment(emits)).min(u32::MAX.into()) as u32
}

impl Made for PosedVoxels {
    const PART: Part = Part::PosedVoxels;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, prepared) = (making.gpu, &making.request.prepared);
        let columns = parts.made::<Columns>(making.keys)?;
        let materials = parts.made::<Materials>(making.keys)?.buffers()?;
        let method = making.key(Part::Columns)?.method();
        let emits = prepared.brightest_emission > 0.0;
        let most = most_fragments(gpu, emits);
        let likely = parts.likely.fragments(method, making.estimated_share, most);
        self.find_room(columns.count().unwrap_or(0), likely, most);
        self.counts = None;
        let discretization = &making.method.settings().method.discretization;
        let shape = (discretization.cells, discretization.depth());
        let store = CellStore::new(gpu, &mut self.store, shape, self.room, emits)?;
        let triangles = columns.triangles()?;
        making.begin(frame, Pass::ClearCells);
        store.record_clear(frame);
        making.begin(frame, Pass::VoxelizeTriangles);
        frame.copy(&columns.total()?, 0, &store.counts, 0, 4);
        let count = columns.count().unwrap_or(0);
        cover::record(gpu, frame, (triangles, prepared.mode), (count, &columns.starts()?), &store);
        shade::record(gpu, frame, triangles, materials, &store);
        making.begin(frame, Pass::MergeFragments);
        let listed = self.list(gpu)?;
        let voxel_count = self.voxel_count.ensure(gpu, "number of voxels", 4)?;
        let emitting = if emits { self.room.voxels } else { 1 };
        let emission = self.emission.ensure(gpu, "emission of posed voxels", EMISSION_BYTES * u64::from(emitting))?;
        merge::record(gpu, frame, &store, &listed, (&voxel_count, &emission));
        self.listed = Some(listed);
        Ok(Some((store.counts, 0..size_of::<FragmentCounts>() as u64)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        self.counts = Some(bytemuck::pod_read_unaligned(bytes));
        Ok(())
    }
}
