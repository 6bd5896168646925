//! Brings back what light arrives at the leaves.

use super::{Engine, EngineError, missing};
use crate::data::light::IRRADIANCE_BYTES;

impl Engine {
    /// Irradiance (lux) that lights and sky bring to each leaf, in the order of [`Self::read_voxels`];
    /// an error where the shown octree has not been lit. Blocks until it is here.
    pub fn read_irradiance(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        if self.done.light.is_none() || !self.has_octree() {
            return Err(missing("direct irradiance").into());
        }
        let direct = self.light.buffers.direct.made("direct irradiance")?;
        Ok(self.gpu.read(&direct, 0..IRRADIANCE_BYTES * u64::from(self.shown.params.leaf_count))?)
    }
}
