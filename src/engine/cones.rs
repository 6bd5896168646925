//! Cones that the pixels of the surface image send through the lit octree.

use super::run::Work;
use super::{Engine, EngineError, Wanted, missing};
use crate::gpu::{GpuError, Recorder};
use crate::settings::ConeTracing;
use crate::stages::cones::diffuse::{self, DiffuseCones, DiffuseParams, DiffuseTerms};
use crate::stages::cones::filter::{self, Traced};
use crate::stages::cones::glossy_tiles::{self, GlossyParams};
use crate::stages::cones::specular::{self, SpecularParams};
use crate::stages::cones::upsample::{self, Pixels};
use crate::stages::cones::{ConesInput, Surfaces, image_bytes};
use crate::stages::sample::{SampledOctree, Sampler};

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
    /// Tiles of the last picture of surfaces whose pixels sent out a specular cone.
    pub fn glossy_tiles(&self) -> u32 {
        if self.done.specular.is_some() { self.surfaces.glossy_count } else { 0 }
    }

    pub(super) fn record_diffuse(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let settings = &wanted.settings.cone_tracing;
        let size_px = settings.diffuse_size_px(wanted.size_px);
        let whole = filter::is_done(wanted.size_px, size_px, settings.pattern_px);
        let slot = if whole { &mut self.surfaces.diffuse } else { &mut self.surfaces.diffuse_traced };
        let diffuse = slot.ensure(&self.gpu, "diffuse cones", image_bytes(size_px))?;
        let asked = wanted.cones_asked();
        let terms = DiffuseTerms { radiance: asked.radiance.is_ok(), occlusion: asked.occlusion.is_ok() };
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let cones = DiffuseCones::new(settings, grid.cells(), grid.span);
        let params = DiffuseParams::new(&cones, wanted.sky_nits(), size_px);
        let view = self.surface_view(wanted)?;
        let octree = self.sampled_by_cones(wanted)?;
        let input = ConesInput { octree: &octree, surfaces: Surfaces { image: self.surface_image()?, view: &view } };
        diffuse::record(&self.gpu, &mut frame, &input, (&sampler(wanted), terms), &params, &diffuse);
        Ok(frame)
    }

    /// From pixels that share cones to every pixel of the picture.
    pub(super) fn record_diffuse_filter(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let settings = &wanted.settings.cone_tracing;
        let size_px = settings.diffuse_size_px(wanted.size_px);
        let traced = self.surfaces.diffuse_traced.made("diffuse cones")?;
        let scratch = self.surfaces.scratch.ensure(&self.gpu, "blurred cones", image_bytes(size_px))?;
        let filtered = self.surfaces.diffuse.ensure(&self.gpu, "diffuse light", image_bytes(wanted.size_px))?;
        let view = self.surface_view(wanted)?;
        let surfaces = Surfaces { image: self.surface_image()?, view: &view };
        let traced = Traced { image: &traced, size_px, pattern_px: settings.pattern_px, pixels: Pixels::All };
        filter::record(&self.gpu, &mut frame, &surfaces, &traced, (&scratch, &filtered));
        Ok(frame)
    }

    pub(super) fn record_glossy_tiles(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let settings = &wanted.settings.cone_tracing;
        let params = GlossyParams::new(settings.specular_size_px(wanted.size_px), settings.glossy_roughness);
        let view = self.surface_view(wanted)?;
        let image = self.surface_image()?.clone();
        let surfaces = Surfaces { image: &image, view: &view };
        let tiles = &mut self.surfaces.glossy_tiles;
        let list = glossy_tiles::record(&self.gpu, &mut frame, &surfaces, &params, tiles)?;
        self.surfaces.glossy_list = Some(list);
        Ok(frame)
    }

    /// Brings back how many tiles are listed.
    pub(super) fn read_glossy_count(&self) -> Result<Work, EngineError> {
        let list = self.surfaces.glossy_list.as_ref().ok_or_else(|| missing("glossy tile list"))?;
        let (buffer, at) = list.count_at();
        Ok(Work::Read(self.gpu.start_read(buffer, at..at + 4)?))
    }

    /// A cone a pixel of the listed tiles; no dispatch where none is.
    pub(super) fn record_specular(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let settings = &wanted.settings.cone_tracing;
        let size_px = settings.specular_size_px(wanted.size_px);
        let is_small = size_px != wanted.size_px;
        let slot = if is_small { &mut self.surfaces.specular_traced } else { &mut self.surfaces.specular };
        let specular = slot.ensure(&self.gpu, "specular cones", image_bytes(size_px))?;
        let list = self.surfaces.glossy_list.clone().ok_or_else(|| missing("glossy tile list"))?;
        let params = SpecularParams::new(settings, wanted.sky_nits(), size_px);
        let view = self.surface_view(wanted)?;
        let octree = self.sampled_by_cones(wanted)?;
        let input = ConesInput { octree: &octree, surfaces: Surfaces { image: self.surface_image()?, view: &view } };
        let listed = (&list, self.surfaces.glossy_count);
        specular::record(&self.gpu, &mut frame, &input, (&sampler(wanted), &params), listed, &specular);
        Ok(frame)
    }

    pub(super) fn record_specular_filter(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let size_px = wanted.settings.cone_tracing.specular_size_px(wanted.size_px);
        let traced = self.surfaces.specular_traced.made("specular cones")?;
        let filtered = self.surfaces.specular.ensure(&self.gpu, "specular light", image_bytes(wanted.size_px))?;
        let view = self.surface_view(wanted)?;
        let surfaces = Surfaces { image: self.surface_image()?, view: &view };
        upsample::record(&self.gpu, &mut frame, &surfaces, (size_px, Pixels::Marked), (&traced, &filtered));
        Ok(frame)
    }

    fn sampled_by_cones(&self, wanted: &Wanted) -> Result<SampledOctree, GpuError> {
        let light = self.light.buffers.light.made("light")?;
        let lookup = wanted.settings.cone_tracing.lookup;
        SampledOctree::new(self.shown.octree()?, &light, lookup, self.shown.pointers(lookup))
    }
}

fn sampler(wanted: &Wanted) -> Sampler {
    let cones = &wanted.settings.cone_tracing;
    Sampler { sampling: cones.sampling, lookup: cones.lookup, opacity: wanted.settings.lighting.opacity }
}
