//! The light of the octree: direct irradiance of the leaves, a light at a time, what cones bring of the sky and of
//! other leaves, and what leaves the leaves, averaged to the root (sections 4.3 and 4.4). Sky and bounces sample what
//! was injected before them, so that the same number of bounces gives the same light whatever was there before.

use super::emission::LeafEmission;
use super::payload::octree;
use super::shadow_maps::{maps_read, no_map};
use super::{Made, Making, Parts, Read};
use crate::data::light::{IRRADIANCE_BYTES, LIGHT_BYTES, light_bytes};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::engine::request::light_params;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass, only_opacity};
use crate::settings::lighting::{Opacity, Shadows};
use crate::stages::light::gather::{self, ConeParams, Cones, Gathered};
use crate::stages::light::illuminate;
use crate::stages::light::inject::{self, Injected};
use crate::stages::light::shadow::ShadowMap;
use crate::stages::light::{LitOctree, average_light};

#[derive(Debug, Default)]
pub struct Light {
    /// Light times opacity, and opacity, of every node: all that a sampler reads.
    pub light: Slot,
    /// Of the leaves, lux.
    pub direct: Slot,
    pub gathered: Slot,
    /// The whole scene's.
    pub root: [f32; 4],
    /// Hides nothing.
    no_map: Option<ShadowMap>,
}

/// Averaged irradiance in the same layout, for the view of it.
#[derive(Debug, Default)]
pub struct Irradiance {
    pub shown: Slot,
    pub root: [f32; 4],
}

/// What [`Injected`] borrows.
struct FromLeaves {
    direct: GpuBuffer,
    gathered: Option<GpuBuffer>,
    /// And what an emission of 1 stands for, nits.
    emission: Option<(GpuBuffer, f32)>,
}

impl FromLeaves {
    fn injected(&self, bounced: bool) -> Injected<'_> {
        let emission = self.emission.as_ref().map(|(buffer, nits)| (buffer, *nits));
        Injected { direct: &self.direct, gathered: self.gathered.as_ref().filter(|_| bounced), emission }
    }
}

/// One lighting on its way into a recording.
struct Lit<'a> {
    making: &'a Making<'a>,
    octree: LitOctree,
    opacity: Opacity,
    light: GpuBuffer,
    from: FromLeaves,
}

impl Lit<'_> {
    /// `passes`: what writes the leaves, and what averages them.
    fn inject(&self, frame: &mut Recorder, bounced: bool, passes: [Pass; 2]) {
        self.making.begin(frame, passes[0]);
        inject::record(self.making.gpu, frame, &self.octree, self.from.injected(bounced), &self.light);
        self.making.begin(frame, passes[1]);
        average_light::record(self.making.gpu, frame, &self.octree, self.opacity, &self.light);
    }

    fn gather(&self, frame: &mut Recorder, gathered: Gathered, irradiance: &GpuBuffer) {
        let lighting = &self.making.method.settings().method.lighting;
        let cones = Cones { count: lighting.cones, aperture_degrees: lighting.cone_degrees, ..Cones::default() };
        let params = ConeParams::new(&cones, self.making.method.sky_nits());
        let from = (&self.light, self.opacity);
        gather::record(self.making.gpu, frame, &self.octree, from, (gathered, &params), irradiance);
    }
}

impl Light {
    fn leaves(&mut self, making: &Making<'_>, parts: &Parts, leaves: u64) -> Result<FromLeaves, EngineError> {
        let (gpu, lighting, bytes) = (making.gpu, &making.method.settings().method.lighting, IRRADIANCE_BYTES * leaves);
        let bounces = making.runs(Pass::Bounces);
        let gathered = bounces.then(|| self.gathered.ensure(gpu, "gathered irradiance", bytes)).transpose()?;
        let emission = leaf_emission(making, parts)?;
        let nits = making.request.prepared.brightest_emission * lighting.emission as f32;
        let direct = self.direct.ensure(gpu, "direct irradiance", bytes)?;
        Ok(FromLeaves { direct, gathered, emission: emission.map(|emission| (emission, nits)) })
    }

    /// What every light adds to every leaf.
    fn record_direct(&mut self, frame: &mut Recorder, lit: &Lit<'_>, parts: &Parts) -> Result<(), EngineError> {
        let making = lit.making;
        let lighting = &making.method.settings().method.lighting;
        making.begin(frame, Pass::Illuminate);
        let bytes = IRRADIANCE_BYTES * u64::from(lit.octree.sizes.params.leaf_count);
        frame.clear_part(&lit.from.direct, bytes);
        if !making.runs(Pass::Illuminate) {
            return Ok(());
        }
        let open = no_map(making.gpu, &mut self.no_map)?;
        let maps = maps_read(making, parts);
        let lights = light_params(&making.request.prepared, &making.method.lights, lighting);
        for (number, light) in lights.iter().enumerate() {
            let map = maps.get(number).filter(|_| lighting.shadows == Shadows::Map).unwrap_or(&open);
            let shadows = (lighting.shadows, map);
            illuminate::record(making.gpu, frame, &lit.octree, &lit.from.direct, light, shadows);
        }
        Ok(())
    }
}

impl Made for Light {
    const PART: Part = Part::Light;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, lighting) = (making.gpu, &making.method.settings().method.lighting);
        let octree = LitOctree::new(octree(making, parts)?)?;
        let params = octree.sizes.params;
        let light = self.light.ensure(gpu, "light", light_bytes(&params, lighting.opacity.is_directional()))?;
        let from = self.leaves(making, parts, params.leaf_count.into())?;
        let lit = Lit { making, octree, opacity: lighting.opacity, light, from };
        self.record_direct(frame, &lit, parts)?;
        lit.inject(frame, false, [Pass::InjectLight, Pass::AverageLight]);
        if making.runs(Pass::GatherSky) {
            making.begin(frame, Pass::GatherSky);
            lit.gather(frame, Gathered::Sky, &lit.from.direct);
            lit.inject(frame, false, [Pass::GatherSky; 2]);
        }
        if let Some(gathered) = &lit.from.gathered {
            for _ in 0..lighting.bounces {
                making.begin(frame, Pass::Bounces);
                lit.gather(frame, Gathered::Bounce, gathered);
                lit.inject(frame, true, [Pass::Bounces; 2]);
            }
        }
        Ok(Some((lit.light, 0..LIGHT_BYTES)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        self.root = bytemuck::pod_read_unaligned(bytes);
        Ok(())
    }
}

impl Made for Irradiance {
    const PART: Part = Part::Irradiance;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, opacity) = (making.gpu, making.method.settings().method.lighting.opacity);
        let octree = LitOctree::new(octree(making, parts)?)?;
        let shown =
            self.shown.ensure(gpu, "shown irradiance", light_bytes(&octree.sizes.params, opacity.is_directional()))?;
        let light = parts.made::<Light>(making.keys)?;
        let gathered = light.gathered.get().filter(|_| making.runs(Pass::Bounces));
        let from = Injected { direct: &light.direct.made("direct irradiance")?, gathered, emission: None };
        making.begin(frame, Pass::AverageIrradiance);
        inject::record_irradiance(gpu, frame, &octree, from, &shown);
        average_light::record(gpu, frame, &octree, opacity, &shown);
        Ok(Some((shown, 0..LIGHT_BYTES)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        self.root = bytemuck::pod_read_unaligned(bytes);
        Ok(())
    }
}

/// What leaves emit, where something does and light is read.
fn leaf_emission(making: &Making<'_>, parts: &Parts) -> Result<Option<GpuBuffer>, EngineError> {
    if making.keys.get(Part::Emission).is_none() || only_opacity(&making.method.asked) {
        return Ok(None);
    }
    let emission = parts.made::<LeafEmission>(making.keys)?;
    Ok(Some(emission.buffers.leaf_emission.made("leaf emission")?))
}
