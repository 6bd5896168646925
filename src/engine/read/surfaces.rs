//! Brings back what the view of surfaces shows, or a part of it.

use super::super::parts::composed::{ComposedLight, compose};
use super::super::state::FinishedFrame;
use super::super::{Engine, EngineError};
use super::missing;
use crate::gpu::{Job, Recorder};
use crate::plan::{ConesAsked, Part};
use crate::settings::{SurfaceView, View};
use crate::stages::cones::image_bytes;
use crate::stages::surface::RADIANCE_BYTES;

impl Engine {
    /// The finished frame, where it shows surfaces.
    fn shown_surfaces(&self) -> Option<&FinishedFrame> {
        let shows = |shown: &&FinishedFrame| {
            shown.request.settings().method.look.view == View::Surfaces && !shown.request.shows_nothing()
        };
        self.shown.as_ref().filter(shows)
    }

    /// What the view of surfaces shows, in linear light: four f32 a pixel, rows from the top, the last 1 where a
    /// surface is. Radiance in nits, irradiance in lux, depth in scene units, normals in world axes. Blocks
    /// until it is here; `None` where another view is shown.
    pub fn read_surfaces(&self) -> Result<Option<Vec<[f32; 4]>>, EngineError> {
        let Some(shown) = self.shown_surfaces() else { return Ok(None) };
        let composed = shown.keys.first().and_then(|keys| self.parts.finished::<ComposedLight>(keys));
        let composed = composed.ok_or_else(|| missing("shown light"))?;
        let light = composed.shown.made("shown light")?;
        Ok(Some(self.gpu.read(&light, 0..image_bytes(shown.request.shot.size_px))?))
    }

    /// A part of the finished frame, as [`Self::read_surfaces`] gives what is shown; `None` where that frame
    /// did not make it. Blocks until it is here.
    pub fn read_surface_part(&self, part: SurfaceView) -> Result<Option<Vec<[f32; 4]>>, EngineError> {
        let Some(shown) = self.shown_surfaces().filter(|shown| self.has_made(shown, part)) else { return Ok(None) };
        let Some(making) = self.making(shown, Part::ComposedLight) else { return Ok(None) };
        let usage = wgpu::BufferUsages::empty();
        let into = self.gpu.buffer("a part of shown light", image_bytes(shown.request.shot.size_px), usage)?;
        let nothing = self.gpu.buffer("no light", RADIANCE_BYTES, usage)?;
        let mut recorder = Recorder::default();
        compose(&making, &self.parts, &mut recorder, part, (&into, &nothing))?;
        Job::new(recorder).run_to_end(&self.gpu)?;
        Ok(Some(self.gpu.read(&into, 0..into.bytes())?))
    }

    fn has_made(&self, shown: &FinishedFrame, surface: SurfaceView) -> bool {
        let has = |part: Part| shown.keys.first().is_some_and(|keys| keys.get(part).is_some());
        match surface {
            SurfaceView::Final => shown.request.settings().method.look.surface == SurfaceView::Final,
            SurfaceView::Direct => has(Part::DirectLight),
            SurfaceView::Ao => {
                has(Part::DiffuseLight) && ConesAsked::new(&shown.request.shown().asked).occlusion.is_ok()
            }
            SurfaceView::Diffuse | SurfaceView::Irradiance => has(Part::DiffuseLight),
            SurfaceView::Specular => has(Part::SpecularLight) || has(Part::DiffuseLight),
            _ => has(Part::SurfaceImage),
        }
    }
}
