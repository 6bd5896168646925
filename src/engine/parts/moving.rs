//! What moves voxels: those of the caches, the matrices, and where the moved ones go.

use super::caches::Caches;
use super::pages::Pages;
use super::{Making, Parts};
use crate::data::pages::ListedVoxels;
use crate::engine::EngineError;
use crate::gpu::GpuError;
use crate::stages::transform::MovingVoxels;

/// Of the frame's pages.
pub fn moving_voxels(making: &Making<'_>, parts: &Parts) -> Result<MovingVoxels, EngineError> {
    let caches = parts.made::<Caches>(making.keys)?;
    let pages = parts.made::<Pages>(making.keys)?;
    let missing = || GpuError::Missing { label: "cache voxels".to_owned() };
    let listed = ListedVoxels {
        work_items: pages.work_items()?,
        work_hints: pages.work_hints()?,
        parts: pages.parts()?,
        world_voxels: pages.world_voxels()?,
        threads: pages.list().threads,
    };
    Ok(MovingVoxels {
        listed,
        matrices: pages.matrices()?,
        cache_voxels: caches.voxels.clone().ok_or_else(missing)?,
        cache_joints: caches.joints.clone(),
        rigid_threads: pages.rigid_threads(),
    })
}
