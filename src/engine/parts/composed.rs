//! What is shown of the lit surfaces, in linear light, and what it is multiplied by.

use super::cones::{DiffuseLight, SpecularLight};
use super::surfaces::{DirectLight, surface_image};
use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::settings::SurfaceView;
use crate::stages::cones::image_bytes;
use crate::stages::surface::RADIANCE_BYTES;
use crate::stages::surface::compose::{self, ComposeParams, Terms};
use crate::stages::surface::count_luminance::{self, COUNT_BYTES};
use crate::stages::surface::expose::{self, EXPOSURE_BYTES, PictureExposure};

#[derive(Debug, Default)]
pub struct ComposedLight {
    pub shown: Slot,
    /// In place of light that was not traced.
    nothing: Slot,
}

#[derive(Debug, Default)]
pub struct Exposure {
    counts: Slot,
    pub exposure: Slot,
    /// As the GPU has found it.
    pub measured: PictureExposure,
}

impl Made for ComposedLight {
    const PART: Part = Part::ComposedLight;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let shown = self.shown.ensure(making.gpu, "shown light", image_bytes(making.request.shot.size_px))?;
        let nothing = self.nothing.ensure(making.gpu, "no light", RADIANCE_BYTES)?;
        making.begin(frame, Pass::ComposeSurfaces);
        compose(making, parts, frame, making.method.settings().method.look.surface, (&shown, &nothing))?;
        Ok(None)
    }
}

/// Puts together what a view of surfaces shows, from the terms that the method calls for.
pub fn compose(
    making: &Making<'_>,
    parts: &Parts,
    frame: &mut Recorder,
    surface: SurfaceView,
    (shown, nothing): (&GpuBuffer, &GpuBuffer),
) -> Result<(), EngineError> {
    let view = making.view();
    let params = ComposeParams {
        sky: making.method.sky_nits(),
        glossy_roughness: making.method.settings().method.cone_tracing.glossy_roughness as f32,
        span: making.request.grid().span as f32,
        pad: 0,
        pad_end: [0; 2],
    };
    let direct = parts.get::<DirectLight>(making.keys).and_then(|light| light.direct.get());
    let diffuse = parts.get::<DiffuseLight>(making.keys).and_then(|light| light.diffuse.get());
    let specular = parts.get::<SpecularLight>(making.keys).and_then(|light| light.specular.get());
    let terms = Terms { direct, diffuse, specular, nothing };
    let image = surface_image(making, parts)?;
    compose::record(making.gpu, frame, image, (&view, &params), (surface, terms), shown);
    Ok(())
}

impl Made for Exposure {
    const PART: Part = Part::Exposure;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let gpu = making.gpu;
        let composed = parts.made::<ComposedLight>(making.keys)?;
        let counts = self.counts.ensure(gpu, "counts of luminance", COUNT_BYTES)?;
        let exposure = self.exposure.ensure_as(gpu, "exposure", EXPOSURE_BYTES, wgpu::BufferUsages::UNIFORM)?;
        let [width, height] = making.request.shot.size_px;
        making.begin(frame, Pass::MeasureExposure);
        count_luminance::record(gpu, frame, width * height, &composed.shown.made("shown light")?, &counts);
        expose::record(gpu, frame, &counts, &exposure);
        Ok(Some((exposure, 0..EXPOSURE_BYTES)))
    }

    fn received(&mut self, _: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
        self.measured = bytemuck::pod_read_unaligned(bytes);
        Ok(())
    }
}
