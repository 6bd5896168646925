//! What the voxelizer of posed triangles reads of materials and textures: uploaded once.

use std::collections::BTreeSet;

use super::{Made, Making, Parts, Read};
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, GpuError, Recorder};
use crate::plan::Part;
use crate::prepare::Prepared;
use crate::settings::Discretization;
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
        let used = used_materials(prepared, &making.method.settings().method.discretization);
        let is_used = |material: usize| used.contains(&material);
        let made = SurfaceMaterials::new(&prepared.scene, &prepared.textures, shape, is_used);
        self.materials = Some(making.gpu.upload("surface materials", &made.materials)?);
        self.texels = Some(making.gpu.upload("surface texels", &made.texels)?);
        Ok(None)
    }
}

/// Of all that is voxelized every frame, hidden or not.
fn used_materials(prepared: &Prepared, discretization: &Discretization) -> BTreeSet<usize> {
    let voxelized = prepared.objects.iter().filter(|object| object.is_voxelized(discretization));
    let primitives = voxelized.flat_map(|object| &prepared.scene.meshes[object.object.mesh].primitives);
    primitives.filter_map(|primitive| primitive.material).collect()
}

impl Materials {
    pub fn buffers(&self) -> Result<(&GpuBuffer, &GpuBuffer), GpuError> {
        let missing = || GpuError::Missing { label: "surface materials".to_owned() };
        self.materials.as_ref().zip(self.texels.as_ref()).ok_or_else(missing)
    }
}
