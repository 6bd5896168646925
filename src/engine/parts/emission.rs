//! What leaves emit, where something in the scene does.

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
    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let voxels = parts.moving_voxels(making)?;
        let octree = parts.octree(making)?;
        let fill = Filling::made(octree)?;
        let caches = parts.caches.made(making.key(Part::Caches)?, "caches")?;
        let missing = || GpuError::Missing { label: "cache emission".to_owned() };
        let of_caches = caches.emission.clone().ok_or_else(missing)?;
        let filter = parts.masks.made(making.key(Part::Masks)?, "octree masks")?.filter;
        let from = (of_caches, voxels.threads());
        let emission = Emission::new(making.gpu, &mut self.buffers, octree.sizes, from)?;
        making.begin(frame, Pass::GatherEmission);
        place_emission::record(making.gpu, frame, &voxels, octree.sizes, &fill, &emission);
        gather_emission::record(making.gpu, frame, octree.sizes, filter, &fill, &emission);
        Ok(None)
    }
}
