//! World voxels. Voxel transformation (section 4.2): one half of the pages, of static and rigid objects or of skinned ones, moved
//! for the pose. The halves lie in the buffers of their pages; each is moved by itself.

use super::joined_voxels::JoinedVoxels;
use super::moving::moving_voxels;
use super::pages::Pages;
use super::posed_voxels::PosedVoxels;
use super::{Made, Making, Parts, Read};
use crate::data::pages::ListedVoxels;
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

/// The world voxels of the frame, by whichever discretizer, or by both.
pub fn world_voxels(making: &Making<'_>, parts: &Parts) -> Result<ListedVoxels, EngineError> {
    if let Some(voxels) = parts.get::<JoinedVoxels>(making.keys) {
        return Ok(voxels.listed()?);
    }
    match parts.get::<PosedVoxels>(making.keys) {
        Some(voxels) => Ok(voxels.listed()?),
        None => Ok(moving_voxels(making, parts)?.listed),
    }
}

fn begin(making: &Making<'_>, parts: &Parts) -> Result<MovingVoxels, EngineError> {
    let pages = parts.made::<Pages>(making.keys)?;
    pages.write_matrices(making.gpu, making.method)?;
    moving_voxels(making, parts)
}

impl Made for RigidVoxels {
    const PART: Part = Part::RigidVoxels;

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
    const PART: Part = Part::SkinnedVoxels;

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
