//! Cones that the pixels of the surface image send through the lit octree (section 4.5).

use super::light::Light;
use super::links::pointers;
use super::payload::octree;
use super::surfaces::surface_image;
use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{ConesAsked, Part, Pass};
use crate::settings::Lookup;
use crate::stages::cones::diffuse::{self, DiffuseCones, DiffuseParams, DiffuseTerms};
use crate::stages::cones::filter::{self, Traced};
use crate::stages::cones::glossy_tiles::{self, GlossyParams, TileBuffers, TileList};
use crate::stages::cones::specular::{self, SpecularParams};
use crate::stages::cones::upsample::{self, Pixels};
use crate::stages::cones::{ConesInput, Surfaces, image_bytes};
use crate::stages::sample::{SampledOctree, Sampler};

#[derive(Debug, Default)]
pub struct DiffuseLight {
    /// Where pixels share cones.
    traced: Slot,
    scratch: Slot,
    pub diffuse: Slot,
}

/// The tiles that need a specular cone. How many the GPU counts; the cones are dispatched for as many as the last
/// time and a share more, and the count comes back later.
#[derive(Debug, Default)]
pub struct GlossyTiles {
    buffers: TileBuffers,
    list: Option<TileList>,
    pub count: Option<u32>,
    room: Option<u32>,
}

#[derive(Debug, Default)]
pub struct SpecularLight {
    traced: Slot,
    pub specular: Slot,
}

impl GlossyTiles {
    /// For how many tiles cones are dispatched; `None` while nothing is known.
    pub fn room(&self) -> Option<u32> {
        self.count.or(self.room)
    }

    pub fn has_outgrown(&self) -> bool {
        matches!((self.count, self.room), (Some(count), Some(room)) if count > room)
    }
}

fn sampler(making: &Making<'_>) -> Sampler {
    let settings = making.method.settings();
    let cones = &settings.method.cone_tracing;
    Sampler { sampling: cones.sampling, lookup: cones.lookup, opacity: settings.method.lighting.opacity }
}

impl Made for DiffuseLight {
    const PART: Part = Part::DiffuseLight;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, grid) = (making.gpu, making.request.grid());
        let (settings, picture_px) = (&making.method.settings().method.cone_tracing, making.request.shot.size_px);
        let size_px = settings.diffuse_size_px(picture_px);
        let whole = filter::is_done(picture_px, size_px, settings.pattern_px);
        let slot = if whole { &mut self.diffuse } else { &mut self.traced };
        let traced = slot.ensure(gpu, "diffuse cones", image_bytes(size_px))?;
        let asked = ConesAsked::new(&making.method.asked);
        let terms = DiffuseTerms { radiance: asked.radiance.is_ok(), occlusion: asked.occlusion.is_ok() };
        let cones = DiffuseCones::new(settings, grid.cells(), grid.span);
        let params = DiffuseParams::new(&cones, making.method.sky_nits(), size_px);
        let (view, octree) = (making.view(), sampled(making, parts, settings.lookup)?);
        let surfaces = Surfaces { image: surface_image(making, parts)?, view: &view };
        let input = ConesInput { octree: &octree, surfaces };
        making.begin(frame, Pass::TraceDiffuse);
        diffuse::record(gpu, frame, &input, (&sampler(making), terms), &params, &traced);
        if whole {
            return Ok(None);
        }
        let scratch = self.scratch.ensure(gpu, "blurred cones", image_bytes(size_px))?;
        let filtered = self.diffuse.ensure(gpu, "diffuse light", image_bytes(picture_px))?;
        let traced = Traced { image: &traced, size_px, pattern_px: settings.pattern_px, pixels: Pixels::All };
        making.begin(frame, if settings.pattern_px > 1 { Pass::BlurDiffuse } else { Pass::UpsampleDiffuse });
        filter::record(gpu, frame, &surfaces, &traced, (&scratch, &filtered));
        Ok(None)
    }
}

impl Made for GlossyTiles {
    const PART: Part = Part::GlossyTiles;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let settings = &making.method.settings().method.cone_tracing;
        let size_px = settings.specular_size_px(making.request.shot.size_px);
        let params = GlossyParams::new(size_px, settings.glossy_roughness);
        let view = making.view();
        let surfaces = Surfaces { image: surface_image(making, parts)?, view: &view };
        (self.count, self.room) = (None, parts.likely.glossy_tiles(making.own_key()?.method(), making.estimated_share));
        making.begin(frame, Pass::ListGlossyTiles);
        let list = glossy_tiles::record(making.gpu, frame, &surfaces, &params, &mut self.buffers)?;
        let (buffer, at) = list.count_at();
        let read = (buffer.clone(), at..at + 4);
        self.list = Some(list);
        Ok(Some(read))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        self.count = Some(bytemuck::pod_read_unaligned(bytes));
        Ok(())
    }
}

impl Made for SpecularLight {
    const PART: Part = Part::SpecularLight;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let gpu = making.gpu;
        let (settings, picture_px) = (&making.method.settings().method.cone_tracing, making.request.shot.size_px);
        let size_px = settings.specular_size_px(picture_px);
        let is_small = size_px != picture_px;
        let slot = if is_small { &mut self.traced } else { &mut self.specular };
        let traced = slot.ensure(gpu, "specular cones", image_bytes(size_px))?;
        let tiles = parts.made::<GlossyTiles>(making.keys)?;
        let missing = || GpuError::Missing { label: "glossy tile list".to_owned() };
        let listed = (tiles.list.as_ref().ok_or_else(missing)?, tiles.room().unwrap_or_default());
        let params = SpecularParams::new(settings, making.method.sky_nits(), size_px);
        // Nodes are found by rank, whatever the others follow.
        let (view, octree) = (making.view(), sampled(making, parts, Lookup::Ranks)?);
        let surfaces = Surfaces { image: surface_image(making, parts)?, view: &view };
        let input = ConesInput { octree: &octree, surfaces };
        making.begin(frame, Pass::TraceSpecular);
        specular::record(gpu, frame, &input, (&sampler(making), &params), listed, &traced);
        if is_small {
            let filtered = self.specular.ensure(gpu, "specular light", image_bytes(picture_px))?;
            making.begin(frame, Pass::UpsampleSpecular);
            upsample::record(gpu, frame, &surfaces, (size_px, Pixels::Marked), (&traced, &filtered));
        }
        Ok(None)
    }
}

/// The lit octree as samplers with a look-up read it.
pub fn sampled(making: &Making<'_>, parts: &Parts, lookup: Lookup) -> Result<SampledOctree, EngineError> {
    let light = parts.made::<Light>(making.keys)?.light.made("light")?;
    Ok(SampledOctree::new(octree(making, parts)?, &light, lookup, pointers(making, parts, lookup).as_ref())?)
}
