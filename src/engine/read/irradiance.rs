//! Brings back what light arrives at the leaves.

use super::super::parts::light::Light;
use super::super::{Engine, EngineError};
use super::missing;
use crate::data::light::IRRADIANCE_BYTES;

impl Engine {
    /// Irradiance (lux) that lights and sky bring to each leaf, in the order of [`Self::read_voxels`];
    /// an error where the shown octree has not been lit. Blocks until it is here.
    pub fn read_irradiance(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        let keys = self.shown.as_ref().and_then(|shown| shown.keys.first());
        let light = keys.and_then(|keys| self.parts.finished::<Light>(keys));
        let (Some(light), Some(built)) = (light, self.shown_octree()) else {
            return Err(missing("direct irradiance").into());
        };
        let direct = light.direct.made("direct irradiance")?;
        Ok(self.gpu.read(&direct, 0..IRRADIANCE_BYTES * u64::from(built.counts.params.leaf_count))?)
    }
}
