//! What the camera sees: the surface image, and the light that reaches it straight from the lights.

use super::payload::octree;
use super::shadow_maps::{maps_read, no_map};
use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::data::surface_image::SurfaceImage;
use crate::engine::EngineError;
use crate::engine::request::light_params;
use crate::gpu::{GpuError, GpuTexture, Recorder};
use crate::plan::{Part, Pass};
use crate::settings::lighting::Shadows;
use crate::stages::cones::image_bytes;
use crate::stages::light::LitOctree;
use crate::stages::light::shadow::ShadowMap;
use crate::stages::pixels::picture::depth_buffer;
use crate::stages::pixels::projection::camera_from_world;
use crate::stages::surface::draw::{self, Viewpoint};
use crate::stages::surface::{Lit, direct, direct_march, emission};

#[derive(Debug, Default)]
pub struct Surfaces {
    image: Option<(SurfaceImage, GpuTexture)>,
    matrices: Slot,
}

#[derive(Debug, Default)]
pub struct DirectLight {
    pub direct: Slot,
    /// Hides nothing.
    no_map: Option<ShadowMap>,
}

impl Surfaces {
    pub fn image(&self) -> Result<&SurfaceImage, GpuError> {
        let missing = || GpuError::Missing { label: "surface image".to_owned() };
        self.image.as_ref().map(|(image, _)| image).ok_or_else(missing)
    }
}

impl Made for Surfaces {
    const PART: Part = Part::SurfaceImage;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, shot, grid) = (making.gpu, &making.request.shot, making.request.grid());
        let (image, depth) = match self.image.take().filter(|(image, _)| image.size_px() == shot.size_px) {
            Some(sized) => sized,
            None => (SurfaceImage::new(gpu, shot.size_px)?, depth_buffer(gpu, shot.size_px)?),
        };
        let posed = parts.posed_mesh(making, &mut self.matrices, &camera_from_world(&shot.camera, grid))?;
        let emission = making.method.settings().method.lighting.emission;
        making.begin(frame, Pass::DrawSurfaces);
        let seen =
            Viewpoint { camera: &shot.camera, grid, farthest: shot.farthest(&making.request.prepared), emission };
        draw::record(gpu, frame, &posed, seen, (&image, &depth));
        self.image = Some((image, depth));
        Ok(None)
    }
}

impl Made for DirectLight {
    const PART: Part = Part::DirectLight;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, lighting) = (making.gpu, &making.method.settings().method.lighting);
        let bytes = image_bytes(making.request.shot.size_px);
        let sum = self.direct.ensure(gpu, "direct light of surfaces", bytes)?;
        let view = making.view();
        let open = no_map(gpu, &mut self.no_map)?;
        let lit = Lit { image: surface_image(making, parts)?, view: &view, direct: &sum };
        making.begin(frame, Pass::EmitSurfaces);
        emission::record(gpu, frame, &lit);
        let lights = light_params(&making.request.prepared, &making.method.lights, lighting);
        if lighting.shadows == Shadows::March && !lights.is_empty() {
            let octree = LitOctree::new(octree(making, parts)?)?;
            making.begin(frame, Pass::LightByMarching);
            lights.iter().for_each(|light| direct_march::record(gpu, frame, &lit, light, &octree));
            return Ok(None);
        }
        let maps = maps_read(making, parts);
        making.begin(frame, Pass::LightSurfaces);
        for (number, light) in lights.iter().enumerate() {
            let map = maps.get(number).filter(|_| lighting.shadows == Shadows::Map).unwrap_or(&open);
            direct::record(gpu, frame, &lit, light, map);
        }
        Ok(None)
    }
}

pub fn surface_image<'a>(making: &Making<'_>, parts: &'a Parts) -> Result<&'a SurfaceImage, EngineError> {
    Ok(parts.made::<Surfaces>(making.keys)?.image()?)
}
