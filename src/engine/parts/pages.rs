//! Object I-O (section 4.2): parts that reach into the grid get segments of the pages, those that leave give them
//! back. What each voxel's thread reads is listed here; nothing runs on the GPU.

use super::caches::Caches;
use super::{Made, Making, Parts, Read};
use crate::data::matrix::Matrix3x4;
use crate::data::octree::Slot;
use crate::data::pages::{self, WorkItem, WorkList, WorkPart};
use crate::engine::EngineError;
use crate::engine::request::Method;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::Part;
use crate::prepare::Prepared;
use crate::stages::transform;

#[derive(Debug, Default)]
pub struct Pages {
    /// `None` before the first frame, which says in which order segments are taken.
    pages: Option<pages::Pages>,
    list: WorkList,
    rigid_threads: u32,
    work_items: Slot,
    work_hints: Slot,
    parts: Slot,
    matrices: Slot,
    world_voxels: Slot,
}

impl Pages {
    /// One thread a voxel.
    pub fn list(&self) -> &WorkList {
        &self.list
    }

    /// Of all pages, filled or not.
    pub fn slot_count(&self) -> u32 {
        self.pages.as_ref().map_or(0, pages::Pages::slot_count)
    }

    pub fn rigid_threads(&self) -> u32 {
        self.rigid_threads
    }

    pub fn work_items(&self) -> Result<GpuBuffer, GpuError> {
        self.work_items.made("work items")
    }

    pub fn work_hints(&self) -> Result<GpuBuffer, GpuError> {
        self.work_hints.made("work hints")
    }

    pub fn parts(&self) -> Result<GpuBuffer, GpuError> {
        self.parts.made("parts")
    }

    pub fn matrices(&self) -> Result<GpuBuffer, GpuError> {
        self.matrices.made("matrices")
    }

    pub fn world_voxels(&self) -> Result<GpuBuffer, GpuError> {
        self.world_voxels.made("world voxel pages")
    }

    /// Overwrites the matrices of this frame before anything submitted later runs.
    pub fn write_matrices(&self, gpu: &Gpu, method: &Method) -> Result<(), GpuError> {
        gpu.write(&self.matrices()?, 0, bytemuck::cast_slice(&method.matrices.matrices))
    }

    fn exchange_objects(&mut self, making: &Making<'_>, parts: &Parts) -> Result<(), EngineError> {
        let (prepared, resident) = (&making.request.prepared, &making.method.matrices.resident);
        let caches = parts.made::<Caches>(making.keys)?;
        let pages = self.pages.get_or_insert_with(|| pages::Pages::new(making.order));
        // Leaving first: what is freed serves those that enter.
        for (index, _) in resident.iter().enumerate().filter(|(_, resident)| !**resident) {
            pages.leave(index as u32);
        }
        let mut work = Vec::new();
        for (index, _) in resident.iter().enumerate().filter(|(_, resident)| **resident) {
            let part = &prepared.parts[index];
            let voxels = part.tile.voxels.len() as u32;
            pages.enter(index as u32, voxels);
            let first_voxel = caches.start(prepared.objects[part.object].cache).first_voxel + part.tile.voxels.start;
            work.push(WorkPart { part: index as u32, object: part.object as u32, first_voxel, voxels });
        }
        self.rigid_threads = rigid_threads(prepared, resident);
        self.list = WorkList::new(pages, work);
        self.world_voxels.ensure(making.gpu, "world voxel pages", pages.bytes())?;
        Ok(())
    }
}

fn rigid_threads(prepared: &Prepared, resident: &[bool]) -> u32 {
    let rigid = prepared.parts.iter().zip(resident).take(prepared.rigid_parts());
    rigid.filter(|(_, resident)| **resident).map(|(part, _)| part.tile.voxels.len() as u32).sum()
}

impl Made for Pages {
    const PART: Part = Part::Pages;

    fn record(&mut self, making: &Making<'_>, parts: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
        self.exchange_objects(making, parts)?;
        let (gpu, prepared, frame) = (making.gpu, &making.request.prepared, &making.method.matrices);
        let caches = parts.made::<Caches>(making.keys)?;
        let with_records = |(index, part): (usize, &transform::PartRecord)| {
            let start = caches.start(prepared.objects[prepared.parts[index].object].cache);
            transform::PartRecord { joints_skew: start.joints_skew, emission_skew: start.emission_skew, ..*part }
        };
        let records: Vec<transform::PartRecord> = frame.parts.iter().enumerate().map(with_records).collect();
        let item_bytes = (self.list.items.len() * size_of::<WorkItem>()) as u64;
        let items = self.work_items.ensure(gpu, "work items", item_bytes)?;
        gpu.write(&items, 0, bytemuck::cast_slice(&self.list.items))?;
        let hints = self.work_hints.ensure(gpu, "work hints", 4 * self.list.hints.len() as u64)?;
        gpu.write(&hints, 0, bytemuck::cast_slice(&self.list.hints))?;
        let uploaded = self.parts.ensure(gpu, "parts", size_of_val(records.as_slice()) as u64)?;
        gpu.write(&uploaded, 0, bytemuck::cast_slice(&records))?;
        self.matrices.ensure(gpu, "matrices", (frame.matrices.len() * size_of::<Matrix3x4>()) as u64)?;
        Ok(None)
    }
}
