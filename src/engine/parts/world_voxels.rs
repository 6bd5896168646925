//! Voxel transformation (section 4.2): one half of the pages, of static and rigid objects or of skinned ones, moved
//! for the pose. The halves lie in the buffers of their pages; each is moved by itself.

use super::{Made, Making, Parts, Read};
use crate::engine::EngineError;
use crate::gpu::{GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::transform::{MovingVoxels, rigid, skinned};

/// Its voxels lie in the buffers of the pages that its key names.
#[derive(Debug, Default)]
pub struct RigidVoxels;

/// The same of skinned ones.
#[derive(Debug, Default)]
pub struct SkinnedVoxels;

impl Parts {
    /// What moves voxels, and what reads them where they have been moved to.
    pub fn moving_voxels(&self, making: &Making<'_>) -> Result<MovingVoxels, EngineError> {
        let caches = self.caches.made(making.key(Part::Caches)?, "caches")?;
        let pages = self.pages.made(making.key(Part::Pages)?, "world voxel pages")?;
        let missing = || GpuError::Missing { label: "cache voxels".to_owned() };
        Ok(MovingVoxels {
            work_items: pages.work_items()?,
            work_hints: pages.work_hints()?,
            parts: pages.parts()?,
            matrices: pages.matrices()?,
            cache_voxels: caches.voxels.clone().ok_or_else(missing)?,
            cache_joints: caches.joints.clone(),
            world_voxels: pages.world_voxels()?,
            rigid_threads: pages.rigid_threads(),
            skinned_threads: pages.threads() - pages.rigid_threads(),
        })
    }
}

fn begin(making: &Making<'_>, parts: &Parts) -> Result<MovingVoxels, EngineError> {
    let pages = parts.pages.made(making.key(Part::Pages)?, "world voxel pages")?;
    pages.write_matrices(making.gpu, making.method)?;
    parts.moving_voxels(making)
}

impl Made for RigidVoxels {
    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let voxels = begin(making, parts)?;
        making.begin(frame, Pass::TransformRigid);
        rigid::record(making.gpu, frame, &voxels, making.request.grid().cells());
        Ok(None)
    }
}

impl Made for SkinnedVoxels {
    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let voxels = begin(making, parts)?;
        let missing = || GpuError::Missing { label: "cache joints".to_owned() };
        let joints = voxels.cache_joints.as_ref().ok_or_else(missing)?;
        making.begin(frame, Pass::TransformSkinned);
        skinned::record(making.gpu, frame, &voxels, joints, making.request.grid().cells());
        Ok(None)
    }
}
