//! What leaves emit, where something in the scene does.

use super::caches::Caches;
use super::masks::Masks;
use super::payload::octree;
use super::posed_voxels::PosedVoxels;
use super::world_voxels::world_voxels;
use super::{Made, Making, Parts, Read};
use crate::data::light::EmissionBuffers;
use crate::engine::EngineError;
use crate::gpu::{GpuError, Recorder};
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
        let of_voxels = match parts.get::<PosedVoxels>(making.keys) {
            Some(voxels) => voxels.emission()?,
            None => {
                let missing = || GpuError::Missing { label: "cache emission".to_owned() };
                parts.made::<Caches>(making.keys)?.emission.clone().ok_or_else(missing)?
            }
        };
        let filter = parts.made::<Masks>(making.keys)?.filter;
        let from = (of_voxels, voxels.threads);
        let emission = Emission::new(making.gpu, &mut self.buffers, octree.sizes, from)?;
        making.begin(frame, Pass::GatherEmission);
        place_emission::record(making.gpu, frame, &voxels, octree.sizes, &fill, &emission);
        gather_emission::record(making.gpu, frame, octree.sizes, filter, &fill, &emission);
        Ok(None)
    }
}
