//! Cones that the pixels of the surface image send through the lit octree.

use super::{Engine, EngineError, Wanted};
use crate::gpu::Recorder;
use crate::settings::ConeTracing;

/// What cones were traced for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TracedBy {
    cones: ConeTracing,
    radiance: bool,
    occlusion: bool,
}

impl TracedBy {
    /// Diffuse cones: what specular ones are set to does not matter.
    pub fn diffuse(wanted: &Wanted) -> Self {
        let ConeTracing { specular, glossy_roughness, .. } = ConeTracing::default();
        let asked = wanted.cones_asked();
        let cones = ConeTracing { specular, glossy_roughness, ..wanted.settings.cone_tracing };
        Self { cones, radiance: asked.radiance.is_ok(), occlusion: asked.occlusion.is_ok() }
    }

    pub fn specular(wanted: &Wanted) -> Self {
        let set = &wanted.settings.cone_tracing;
        let cones = ConeTracing {
            start_voxels: set.start_voxels,
            step_diameters: set.step_diameters,
            sampling: set.sampling,
            lookup: set.lookup,
            indirect_px: set.indirect_px,
            glossy_roughness: set.glossy_roughness,
            ..ConeTracing::default()
        };
        Self { cones, radiance: wanted.cones_asked().specular.is_ok(), occlusion: false }
    }
}

impl Engine {
    pub(super) fn record_diffuse(&mut self, _wanted: &Wanted) -> Result<Recorder, EngineError> {
        Ok(Recorder::default())
    }

    pub(super) fn record_diffuse_filter(&mut self, _wanted: &Wanted) -> Result<Recorder, EngineError> {
        Ok(Recorder::default())
    }

    pub(super) fn record_glossy_tiles(&mut self, _wanted: &Wanted) -> Result<Recorder, EngineError> {
        Ok(Recorder::default())
    }

    pub(super) fn record_specular(&mut self, _wanted: &Wanted) -> Result<Recorder, EngineError> {
        Ok(Recorder::default())
    }

    pub(super) fn record_specular_filter(&mut self, _wanted: &Wanted) -> Result<Recorder, EngineError> {
        Ok(Recorder::default())
    }
}
