//! One list of all world voxels, where some objects are moved and others voxelized: copies of both, the moved ones first.
//! What is behind walks it as it walks either.
//!
//! ```text
//! pages (moved) ─────┐
//!                    ├─► slots │ room for posed voxels      hints │ objects of posed voxels
//! posed voxels ──────┘
//! ```

use super::caches::Caches;
use super::moving::moving_voxels;
use super::pages::Pages;
use super::posed_voxels::PosedVoxels;
use super::{Made, Making, Parts, Read};
use crate::data::fragments::{EMISSION_BYTES, FragmentRoom};
use crate::data::octree::Slot;
use crate::data::pages::{ListedVoxels, WORLD_VOXEL_BYTES, WorkItem};
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::transform::PartRecord;

#[derive(Debug, Default)]
pub struct JoinedVoxels {
    listed: Option<ListedVoxels>,
    work_items: Slot,
    work_hints: Slot,
    parts: Slot,
    world_voxels: Slot,
    emission: Slot,
}

/// What is copied behind what.
struct Joined<'a> {
    pages: &'a Pages,
    moved: ListedVoxels,
    posed: ListedVoxels,
    room: FragmentRoom,
}

impl JoinedVoxels {
    pub fn listed(&self) -> Result<ListedVoxels, GpuError> {
        self.listed.clone().ok_or_else(|| GpuError::Missing { label: "joined voxels".to_owned() })
    }

    /// Of the caches' voxels, and behind it of the posed ones.
    pub fn emission(&self) -> Result<GpuBuffer, GpuError> {
        self.emission.made("emission of all voxels")
    }

    fn join_voxels(&mut self, gpu: &Gpu, frame: &mut Recorder, joined: &Joined<'_>) -> Result<GpuBuffer, GpuError> {
        let [moved, posed] = [joined.pages.slot_count(), joined.room.voxels].map(|n| WORLD_VOXEL_BYTES * u64::from(n));
        let all = self.world_voxels.ensure(gpu, "all world voxels", moved + posed)?;
        frame.copy(&joined.moved.world_voxels, 0, &all, 0, moved);
        frame.copy(&joined.posed.world_voxels, 0, &all, moved, posed);
        Ok(all)
    }

    /// Hints for all threads, then the posed voxels' objects.
    fn join_lists(
        &mut self,
        gpu: &Gpu,
        frame: &mut Recorder,
        joined: &Joined<'_>,
        part: u32,
    ) -> Result<(ListedVoxels, u32), GpuError> {
        let room = joined.room;
        let (list, first_voxel) = joined.pages.list().with_posed(room.voxels, joined.pages.slot_count(), part);
        let work_items =
            self.work_items.ensure(gpu, "work items", (list.items.len() * size_of::<WorkItem>()) as u64)?;
        gpu.write(&work_items, 0, bytemuck::cast_slice(&list.items))?;
        let work_hints = self.work_hints.ensure(gpu, "work hints", 4 * u64::from(first_voxel + room.voxels))?;
        gpu.write(&work_hints, 0, bytemuck::cast_slice(&list.hints))?;
        let objects_at = 4 * u64::from(room.hints);
        frame.copy(
            &joined.posed.work_hints,
            objects_at,
            &work_hints,
            4 * u64::from(first_voxel),
            4 * u64::from(room.voxels),
        );
        let record_bytes = size_of::<PartRecord>() as u64;
        let parts = self.parts.ensure(gpu, "parts", record_bytes * u64::from(part + 1))?;
        frame.copy(&joined.moved.parts, 0, &parts, 0, record_bytes * u64::from(part));
        let world_voxels = self.join_voxels(gpu, frame, joined)?;
        Ok((ListedVoxels { work_items, work_hints, parts, world_voxels, threads: list.threads }, first_voxel))
    }

    /// Returns the number of the first posed voxel's emission. Even, as its number in the list is: the distance of both
    /// is never the one that stands for none.
    fn join_emission(
        &mut self,
        gpu: &Gpu,
        frame: &mut Recorder,
        (of_caches, of_posed): (Option<&GpuBuffer>, &GpuBuffer),
        voxels: u32,
    ) -> Result<u32, GpuError> {
        let cached_bytes = of_caches.map_or(0, |buffer| buffer.bytes());
        let first = cached_bytes.div_ceil(EMISSION_BYTES).next_multiple_of(2);
        let [at, bytes] = [first, u64::from(voxels)].map(|records| EMISSION_BYTES * records);
        let all = self.emission.ensure(gpu, "emission of all voxels", at + bytes)?;
        of_caches.into_iter().for_each(|of_caches| frame.copy(of_caches, 0, &all, 0, cached_bytes));
        frame.copy(of_posed, 0, &all, at, bytes);
        Ok(first as u32)
    }
}

impl Made for JoinedVoxels {
    const PART: Part = Part::JoinedVoxels;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, prepared) = (making.gpu, &making.request.prepared);
        let pages = parts.made::<Pages>(making.keys)?;
        let posed = parts.made::<PosedVoxels>(making.keys)?;
        let moved = moving_voxels(making, parts)?.listed;
        let joined = Joined { pages, moved, posed: posed.listed()?, room: posed.room() };
        making.begin(frame, Pass::JoinVoxels);
        let part = prepared.parts.len() as u32;
        let (listed, first_voxel) = self.join_lists(gpu, frame, &joined, part)?;
        let mut record = PartRecord::default();
        if prepared.brightest_emission > 0.0 {
            let caches = parts.made::<Caches>(making.keys)?;
            let sources = (caches.emission.as_ref(), &posed.emission()?);
            let first = self.join_emission(gpu, frame, sources, joined.room.voxels)?;
            record.emission_skew = first_voxel.wrapping_sub(first);
        }
        gpu.write(&listed.parts, size_of::<PartRecord>() as u64 * u64::from(part), bytemuck::bytes_of(&record))?;
        self.listed = Some(listed);
        Ok(None)
    }
}
