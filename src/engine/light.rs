//! What lights the shown octree: shadow maps, irradiance, and the store that views and cones sample.

use std::sync::Arc;

use super::steps::Stored;
use super::{Engine, EngineError, Wanted, missing};
use crate::color::luminance;
use crate::data::light::{IRRADIANCE_BYTES, LightBuffers, light_bytes};
use crate::data::octree::Slot;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::lights::PosedLight;
use crate::settings::lighting::{Lighting, Shadows};
use crate::stages::fill::gather_emission;
use crate::stages::fill::place_emission::{self, Emission};
use crate::stages::light::gather::{self, ConeParams, Cones, Gathered};
use crate::stages::light::illuminate::{self, LightParams};
use crate::stages::light::inject::{self, Injected};
use crate::stages::light::shadow::{ShadowMap, ShadowParams};
use crate::stages::light::{LitOctree, average_light};

/// The light of the shown octree.
#[derive(Debug, Default)]
pub struct LightOnGpu {
    pub buffers: LightBuffers,
    /// One a light.
    pub maps: Vec<ShadowMap>,
    pub matrices: Slot,
    /// Hides nothing.
    pub no_map: Option<ShadowMap>,
    /// Light times opacity, and opacity, of the whole scene.
    pub radiance_root: [f32; 4],
    pub irradiance_root: [f32; 4],
}

impl LightOnGpu {
    pub fn stored(&self, stored: Stored) -> &Slot {
        match stored {
            Stored::Radiance => &self.buffers.light,
            Stored::Irradiance => &self.buffers.shown,
        }
    }

    pub fn set_root(&mut self, stored: Stored, root: [f32; 4]) {
        match stored {
            Stored::Radiance => self.radiance_root = root,
            Stored::Irradiance => self.irradiance_root = root,
        }
    }

    /// Luminance of the scene's mean light; 0 where there is none.
    pub fn mean(&self, stored: Stored) -> f64 {
        let [r, g, b, opacity] = match stored {
            Stored::Radiance => self.radiance_root,
            Stored::Irradiance => self.irradiance_root,
        };
        if opacity > 0.0 { luminance([r, g, b].map(f64::from)) / f64::from(opacity) } else { 0.0 }
    }
}

/// What the stored light was computed from.
#[derive(Clone, Debug, PartialEq)]
pub struct LitBy {
    pub lights: Vec<PosedLight>,
    pub lighting: Lighting,
    /// False: of the store, opacity alone.
    pub radiance: bool,
}

impl LitBy {
    pub fn new(wanted: &Wanted) -> Self {
        let radiance = wanted.reads_radiance();
        Self { lights: wanted.lights.clone(), lighting: wanted.settings.lighting.clone(), radiance }
    }

    pub fn is_of(&self, wanted: &Wanted) -> bool {
        self.lights == wanted.lights && self.lighting == wanted.settings.lighting
    }

    /// What is stored is enough for what is wanted.
    pub fn serves(&self, wanted: &Wanted) -> bool {
        self.is_of(wanted) && (self.radiance || !wanted.reads_radiance())
    }
}

impl Engine {
    pub(super) fn lit_octree(&self) -> Result<LitOctree, GpuError> {
        LitOctree::new(self.shown.octree()?)
    }

    pub(super) fn record_emission(&mut self) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let voxels = self.voxels()?;
        let gpu = Arc::clone(&self.gpu);
        let scene = self.scene.as_ref().ok_or(EngineError::NoScene)?;
        let cache_emission = scene.cache_emission().ok_or_else(|| missing("cache emission"))?.clone();
        let fill = self.shown.filled()?;
        let octree = self.shown.sizes_on_gpu()?.clone();
        let emission = Emission::new(&gpu, &mut self.light.buffers, &octree, (cache_emission, voxels.threads()))?;
        place_emission::record(&gpu, &mut frame, &voxels, &octree, &fill, &emission);
        gather_emission::record(&gpu, &mut frame, &octree, self.shown.filter, &fill, &emission);
        Ok(frame)
    }

    /// Direct irradiance: what every light adds to every leaf.
    pub(super) fn record_illuminate(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        self.done.light = None;
        let mut frame = Recorder::default();
        let octree = self.lit_octree()?;
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let lighting = &wanted.settings.lighting;
        let bytes = IRRADIANCE_BYTES * u64::from(octree.sizes.params.leaf_count);
        let gpu = &self.gpu;
        let direct = self.light.buffers.direct.ensure(gpu, "direct irradiance", bytes)?;
        frame.clear(&direct);
        let lights = if wanted.reads_radiance() { &*wanted.lights } else { &[] };
        for (number, light) in lights.iter().enumerate() {
            let is_mapped = lighting.shadows == Shadows::Map;
            let map = match self.light.maps.get(number).filter(|_| is_mapped) {
                Some(map) => map,
                None => &no_map(gpu, &mut self.light.no_map)?,
            };
            let light = LightParams::new(light, &grid, lighting.offset_voxels());
            illuminate::record(gpu, &mut frame, &octree, &direct, &light, (lighting.shadows, map));
        }
        Ok(frame)
    }

    /// What leaves the leaves, and its average; with what bounces gathered where there is a bounce.
    pub(super) fn record_inject(&mut self, wanted: &Wanted, bounced: bool) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let octree = self.lit_octree()?;
        let opacity = wanted.settings.lighting.opacity;
        let light = self.light.buffers.light.ensure(&self.gpu, "light", light_bytes(&octree.sizes.params, opacity))?;
        let from = self.injected(wanted, bounced)?;
        inject::record(&self.gpu, &mut frame, &octree, from.as_ref(), &light);
        average_light::record(&self.gpu, &mut frame, &octree, opacity, &light);
        Ok(frame)
    }

    /// Irradiance in the same layout, for the view of it.
    pub(super) fn record_irradiance(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let octree = self.lit_octree()?;
        let opacity = wanted.settings.lighting.opacity;
        let shown = self.light.buffers.shown.ensure(
            &self.gpu,
            "shown irradiance",
            light_bytes(&octree.sizes.params, opacity),
        )?;
        let from = self.injected(wanted, wanted.settings.lighting.bounces > 0)?;
        inject::record_irradiance(&self.gpu, &mut frame, &octree, from.as_ref(), &shown);
        average_light::record(&self.gpu, &mut frame, &octree, opacity, &shown);
        Ok(frame)
    }

    /// What the sky adds to direct irradiance, through what the octree lets through.
    pub(super) fn record_sky(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let direct = self.light.buffers.direct.made("direct irradiance")?;
        self.record_gather(wanted, Gathered::Sky, &direct)
    }

    /// What the light that is stored now brings from leaf to leaf.
    pub(super) fn record_bounce(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let bytes = IRRADIANCE_BYTES * u64::from(self.shown.params.leaf_count);
        let gathered = self.light.buffers.gathered.ensure(&self.gpu, "gathered irradiance", bytes)?;
        self.record_gather(wanted, Gathered::Bounce, &gathered)
    }

    fn record_gather(
        &self,
        wanted: &Wanted,
        gathered: Gathered,
        irradiance: &GpuBuffer,
    ) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let octree = self.lit_octree()?;
        let light = self.light.buffers.light.made("light")?;
        let lighting = &wanted.settings.lighting;
        let cones = Cones { count: lighting.cones, aperture_degrees: lighting.cone_degrees, ..Cones::default() };
        let params = ConeParams::new(&cones, wanted.sky_nits());
        gather::record(&self.gpu, &mut frame, &octree, (&light, lighting.opacity), (gathered, &params), irradiance);
        Ok(frame)
    }

    fn injected(&self, wanted: &Wanted, bounced: bool) -> Result<InjectedBuffers, EngineError> {
        let b = &self.light.buffers;
        let emission_nits = self.emission_nits(wanted)?;
        let emits = emission_nits > 0.0 && wanted.facts.emissive_voxels > 0 && wanted.reads_radiance();
        Ok(InjectedBuffers {
            direct: b.direct.made("direct irradiance")?,
            gathered: if bounced { Some(b.gathered.made("gathered irradiance")?) } else { None },
            emission: if emits { Some((b.leaf_emission.made("leaf emission")?, emission_nits)) } else { None },
        })
    }

    /// What a leaf emission of 1 stands for.
    fn emission_nits(&self, wanted: &Wanted) -> Result<f32, EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        Ok(prepared.brightest_emission * wanted.settings.lighting.emission as f32)
    }
}

/// What [`Injected`] borrows.
struct InjectedBuffers {
    direct: GpuBuffer,
    gathered: Option<GpuBuffer>,
    emission: Option<(GpuBuffer, f32)>,
}

impl InjectedBuffers {
    fn as_ref(&self) -> Injected<'_> {
        let emission = self.emission.as_ref().map(|(buffer, nits)| (buffer, *nits));
        Injected { direct: &self.direct, gathered: self.gathered.as_ref(), emission }
    }
}

pub(super) fn no_map(gpu: &Gpu, kept: &mut Option<ShadowMap>) -> Result<ShadowMap, GpuError> {
    match kept {
        Some(map) => Ok(map.clone()),
        None => Ok(kept.insert(ShadowMap::new(gpu, ShadowParams::default())?).clone()),
    }
}
