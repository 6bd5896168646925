//! Which object fills each leaf most, where somebody looks at objects.

use super::masks::Masks;
use super::payload::octree;
use super::world_voxels::world_voxels;
use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::Recorder;
use crate::plan::{Part, Pass};
use crate::stages::fill::{Filling, number_objects};

#[derive(Debug, Default)]
pub struct ObjectNumbers {
    pub leaf_objects: Slot,
}

impl Made for ObjectNumbers {
    const PART: Part = Part::ObjectNumbers;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let voxels = world_voxels(making, parts)?;
        let octree = octree(making, parts)?;
        let fill = Filling::made(octree)?;
        let filter = parts.made::<Masks>(making.keys)?.filter;
        let bytes = 4 * u64::from(octree.sizes.params.leaf_count);
        let objects = self.leaf_objects.ensure(making.gpu, "leaf objects", bytes)?;
        let leaf_bits = octree.masks.leaf_bits.made("leaf bits")?;
        making.begin(frame, Pass::NumberObjects);
        let shape = (octree.sizes, filter);
        number_objects::record(making.gpu, frame, &voxels, shape, &fill, (&leaf_bits, &objects));
        Ok(None)
    }
}
