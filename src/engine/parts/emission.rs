//! What leaves emit, where something in the scene does.

use super::caches::Caches;
use super::joined_voxels::JoinedVoxels;
use super::masks::Masks;
use super::payload::octree;
use super::posed_voxels::PosedVoxels;
use super::world_voxels::world_voxels;
use super::{Made, Making, Parts, Read};
use crate::data::light::EmissionBuffers;
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::fill::place_emission::{self, Emission};
use crate::stages::fill::{Filling, gather_emission};

#[derive(Debug, Default)]
pub struct LeafEmission {
    pub buffers: EmissionBuffers,
}

impl Made for LeafEmission {
    const PART: Part = Part::Emission;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let voxels = world_voxels(making, parts)?;
        let octree = octree(making, parts)?;
        let fill = Filling::made(octree)?;
        let of_voxels = emission_of_voxels(making, parts)?;
        let filter = parts.made::<Masks>(making.keys)?.filter;
        let from = (of_voxels, voxels.threads);
        let emission = Emission::new(making.gpu, &mut self.buffers, octree.sizes, from)?;
        making.begin(frame, Pass::GatherEmission);
        place_emission::record(making.gpu, frame, &voxels, octree.sizes, &fill, &emission);
        gather_emission::record(making.gpu, frame, octree.sizes, filter, &fill, &emission);
        Ok(None)
    }
}

/// By the numbers that the list of voxels has.
fn emission_of_voxels(making: &Making<'_>, parts: &Parts) -> Result<GpuBuffer, EngineError> {
    if let Some(voxels) = parts.get::<JoinedVoxels>(making.keys) {
        return Ok(voxels.emission()?);
    }
    if let Some(voxels) = parts.get::<PosedVoxels>(making.keys) {
        return Ok(voxels.emission()?);
    }
    let missing = || GpuError::Missing { label: "cache emission".to_owned() };
    Ok(parts.made::<Caches>(making.keys)?.emission.clone().ok_or_else(missing)?)
}
