//! What the voxelizer of posed triangles reads of materials and textures: uploaded once.

use super::{Made, Making, Parts, Read};
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, GpuError, Recorder};
use crate::plan::Part;
use crate::stages::voxelize::SurfaceMaterials;

#[derive(Debug, Default)]
pub struct Materials {
    materials: Option<GpuBuffer>,
    texels: Option<GpuBuffer>,
}

impl Made for Materials {
    const PART: Part = Part::Materials;

    fn record(&mut self, making: &Making<'_>, _: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
        let prepared = &making.request.prepared;
        let shape = (prepared.grid.cells(), prepared.brightest_emission);
        let made = SurfaceMaterials::new(&prepared.scene, &prepared.textures, shape);
        self.materials = Some(making.gpu.upload("surface materials", &made.materials)?);
        self.texels = Some(making.gpu.upload("surface texels", &made.texels)?);
        Ok(None)
    }
}

impl Materials {
    pub fn buffers(&self) -> Result<(&GpuBuffer, &GpuBuffer), GpuError> {
        let missing = || GpuError::Missing { label: "surface materials".to_owned() };
        self.materials.as_ref().zip(self.texels.as_ref()).ok_or_else(missing)
    }
}
