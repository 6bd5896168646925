//! A prepared scene on the GPU: caches, pages, work list and matrices. Object I-O happens here
//! (section 4.2): parts that reach into the grid get segments, those that leave give them back.

use std::sync::Arc;

use crate::data::light::pack_emission;
use crate::data::octree::{NO_BLOCK, Slot};
use crate::data::pages::{Pages, SegmentOrder, WorkItem, WorkList, WorkPart};
use crate::gpu::{Gpu, GpuBuffer, GpuError};
use crate::plan::SceneFacts;
use crate::prepare::{FrameMatrices, Prepared};
use crate::scene::{Primitive, Scene};
use crate::settings::Hidden;
use crate::stages::transform::{Matrix3x4, MovingVoxels, Part};

#[derive(Debug)]
pub struct SceneOnGpu {
    prepared: Arc<Prepared>,
    cache_voxels: GpuBuffer,
    cache_joints: Option<GpuBuffer>,
    /// In units of the brightest; made only where something emits.
    cache_emission: Option<GpuBuffer>,
    cache_starts: Vec<CacheStart>,
    pages: Pages,
    /// What the matrices, parts and pages on the GPU were made from.
    frame: FrameMatrices,
    work: WorkList,
    work_items: Slot,
    work_hints: Slot,
    parts: Slot,
    matrices: Slot,
    world_voxels: Slot,
}

/// Where a cache begins among all that is uploaded.
#[derive(Clone, Copy, Debug)]
struct CacheStart {
    first_voxel: u32,
    /// Distance from the cache's first joint record.
    joints_skew: u32,
    /// Distance from its first emission record; [`NO_BLOCK`] without any.
    emission_skew: u32,
}

/// What of a frame differs from the one on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameChanges {
    pub residents: bool,
    pub rigid_poses: bool,
    pub skinned_poses: bool,
}

/// Counts a frame's voxels in the grid, and the triangles of what is not hidden.
pub fn facts(prepared: &Prepared, frame: &FrameMatrices, hidden: &Hidden, glossy_roughness: f64) -> SceneFacts {
    let mut facts = SceneFacts::default();
    for (part, _) in prepared.parts.iter().zip(&frame.resident).filter(|(_, resident)| **resident) {
        let voxels = part.tile.voxels.len() as u64;
        if prepared.is_skinned(part) {
            facts.skinned_voxels += voxels
        } else {
            facts.rigid_voxels += voxels
        }
        if !prepared.caches[prepared.objects[part.object].cache].emission.is_empty() {
            facts.emissive_voxels += voxels;
        }
    }
    let shown = (0..).zip(&prepared.objects).filter(|(index, _)| !hidden.contains(*index));
    let scene = &prepared.scene;
    for (_, object) in shown {
        let mesh = &scene.meshes[object.object.mesh];
        facts.triangles += mesh.triangle_count() as u64;
        facts.glossy |= mesh.primitives.iter().any(|primitive| may_be_glossy(scene, primitive, glossy_roughness));
    }
    facts
}

/// What a texture makes of a roughness is known per pixel only.
fn may_be_glossy(scene: &Scene, primitive: &Primitive, glossy_roughness: f64) -> bool {
    let material = primitive.material.and_then(|material| scene.materials.get(material));
    material.is_some_and(|material| {
        let is_smooth = f64::from(material.roughness) <= glossy_roughness;
        !material.unlit && (is_smooth || material.metallic_roughness_texture.is_some())
    })
}

impl SceneOnGpu {
    /// Uploads the caches, each once however many objects use it.
    pub fn upload(gpu: &Gpu, prepared: &Arc<Prepared>, order: SegmentOrder) -> Result<Self, GpuError> {
        let mut voxels = Vec::new();
        let mut joints = Vec::new();
        let mut emission = Vec::new();
        let mut cache_starts = Vec::new();
        for cache in &prepared.caches {
            let no_emission = cache.emission.is_empty();
            cache_starts.push(CacheStart {
                first_voxel: voxels.len() as u32,
                joints_skew: (voxels.len() - joints.len()) as u32,
                emission_skew: if no_emission { NO_BLOCK } else { (voxels.len() - emission.len()) as u32 },
            });
            voxels.extend_from_slice(&cache.voxels);
            joints.extend_from_slice(&cache.joints);
            emission.extend(cache.emission.iter().map(|voxel| pack_emission(*voxel, prepared.brightest_emission)));
        }
        let cache_joints = if joints.is_empty() { None } else { Some(gpu.upload("cache joints", &joints)?) };
        Ok(Self {
            prepared: Arc::clone(prepared),
            cache_voxels: gpu.upload("cache voxels", &voxels)?,
            cache_joints,
            cache_emission: if emission.is_empty() { None } else { Some(gpu.upload("cache emission", &emission)?) },
            cache_starts,
            pages: Pages::new(order),
            frame: FrameMatrices::default(),
            work: WorkList::default(),
            work_items: Slot::default(),
            work_hints: Slot::default(),
            parts: Slot::default(),
            matrices: Slot::default(),
            world_voxels: Slot::default(),
        })
    }

    pub fn changes(&self, frame: &FrameMatrices) -> FrameChanges {
        let (rigid, skinned) = self.rigid_and_skinned(frame);
        let (old_rigid, old_skinned) = self.rigid_and_skinned(&self.frame);
        FrameChanges {
            residents: frame.resident != self.frame.resident,
            rigid_poses: rigid != old_rigid,
            skinned_poses: skinned != old_skinned,
        }
    }

    fn rigid_and_skinned<'a>(&self, frame: &'a FrameMatrices) -> (&'a [Matrix3x4], &'a [Matrix3x4]) {
        frame.matrices.split_at(self.rigid_parts().min(frame.matrices.len()))
    }

    /// Rigid parts come first, with one matrix each.
    fn rigid_parts(&self) -> usize {
        self.prepared.parts.iter().take_while(|part| !self.prepared.is_skinned(part)).count()
    }

    /// Object I-O and the frame's matrices.
    pub fn set_frame(&mut self, gpu: &Gpu, frame: &FrameMatrices) -> Result<(), GpuError> {
        if frame.resident != self.frame.resident {
            self.exchange_objects(gpu, frame)?;
        }
        let parts: Vec<Part> =
            frame.parts.iter().enumerate().map(|(index, part)| self.with_records(index, part)).collect();
        let part_bytes = size_of_val(parts.as_slice()) as u64;
        let matrix_bytes = (frame.matrices.len() * size_of::<Matrix3x4>()) as u64;
        let buffer = self.parts.ensure(gpu, "parts", part_bytes)?;
        gpu.write(&buffer, 0, bytemuck::cast_slice(&parts))?;
        let buffer = self.matrices.ensure(gpu, "matrices", matrix_bytes)?;
        gpu.write(&buffer, 0, bytemuck::cast_slice(&frame.matrices))?;
        self.frame = frame.clone();
        Ok(())
    }

    fn with_records(&self, index: usize, part: &Part) -> Part {
        let start = self.cache_starts[self.prepared.objects[self.prepared.parts[index].object].cache];
        Part { joints_skew: start.joints_skew, emission_skew: start.emission_skew, ..*part }
    }

    fn exchange_objects(&mut self, gpu: &Gpu, frame: &FrameMatrices) -> Result<(), GpuError> {
        // Leaving first: what is freed serves those that enter.
        for (index, _) in frame.resident.iter().enumerate().filter(|(_, resident)| !**resident) {
            self.pages.leave(index as u32);
        }
        let mut work = Vec::new();
        for (index, _) in frame.resident.iter().enumerate().filter(|(_, resident)| **resident) {
            let part = &self.prepared.parts[index];
            let voxels = part.tile.voxels.len() as u32;
            self.pages.enter(index as u32, voxels);
            let cache = self.prepared.objects[part.object].cache;
            let first_voxel = self.cache_starts[cache].first_voxel + part.tile.voxels.start;
            work.push(WorkPart { part: index as u32, object: part.object as u32, first_voxel, voxels });
        }
        self.work = WorkList::new(&self.pages, work);
        let item_bytes = (self.work.items.len() * size_of::<WorkItem>()) as u64;
        let items = self.work_items.ensure(gpu, "work items", item_bytes)?;
        gpu.write(&items, 0, bytemuck::cast_slice(&self.work.items))?;
        let hints = self.work_hints.ensure(gpu, "work hints", 4 * self.work.hints.len() as u64)?;
        gpu.write(&hints, 0, bytemuck::cast_slice(&self.work.hints))?;
        self.world_voxels.ensure(gpu, "world voxel pages", self.pages.bytes())?;
        Ok(())
    }

    /// What the transform reads and writes; `None` while nothing is in the grid.
    pub fn moving_voxels(&self) -> Option<MovingVoxels> {
        let resident = self.prepared.parts.iter().zip(&self.frame.resident).filter(|(_, resident)| **resident);
        let rigid =
            resident.filter(|(part, _)| !self.prepared.is_skinned(part)).map(|(part, _)| part.tile.voxels.len());
        let rigid_threads = rigid.sum::<usize>() as u32;
        Some(MovingVoxels {
            work_items: self.work_items.get()?.clone(),
            work_hints: self.work_hints.get()?.clone(),
            parts: self.parts.get()?.clone(),
            matrices: self.matrices.get()?.clone(),
            cache_voxels: self.cache_voxels.clone(),
            cache_joints: self.cache_joints.clone(),
            world_voxels: self.world_voxels.get()?.clone(),
            rigid_threads,
            skinned_threads: self.work.threads - rigid_threads,
        })
    }

    /// Emission records of the caches; `None` where nothing emits.
    pub fn cache_emission(&self) -> Option<&GpuBuffer> {
        self.cache_emission.as_ref()
    }

    pub fn grid_cells(&self) -> u32 {
        self.prepared.grid.cells()
    }
}
