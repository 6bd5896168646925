//! The lit surfaces that the camera sees: surface image, direct light, and the picture of it all.

use super::light::no_map;
use super::wanted::Placed;
use super::{Engine, EngineError, Wanted, missing};
use crate::data::octree::Slot;
use crate::data::surface_image::SurfaceImage;
use crate::gpu::{Gpu, GpuBuffer, GpuError, GpuTexture, Job, Recorder};
use crate::scene::OrbitCamera;
use crate::settings::lighting::Shadows;
use crate::settings::{ColorBy, SurfaceView};
use crate::stages::cones::glossy_tiles::{TileBuffers, TileList};
use crate::stages::cones::image_bytes;
use crate::stages::light::illuminate::LightParams;
use crate::stages::mesh::PosedMesh;
use crate::stages::surface::compose::{self, ComposeParams, Terms};
use crate::stages::surface::draw::{self, Seen};
use crate::stages::surface::sum_luminance::{self, SUM_BYTES};
use crate::stages::surface::{Lit, RADIANCE_BYTES, direct, direct_march, emission};
use crate::stages::view::camera::PixelRays;
use crate::stages::view::mesh::camera_from_world;
use crate::stages::view::picture::depth_buffer;
use crate::stages::view::show_surfaces::{self, ShowSurfacesParams, ShownExposure};
use crate::stages::view::{Palette, Picture, ViewParams};

/// Images between surface image and picture, each made when it is first asked for.
#[derive(Debug, Default)]
pub struct SurfacesOnGpu {
    pub image: Option<SurfaceImage>,
    pub depth: Option<GpuTexture>,
    pub matrices: Slot,
    pub direct: Slot,
    /// Where pixels share cones.
    pub diffuse_traced: Slot,
    pub scratch: Slot,
    pub diffuse: Slot,
    pub specular_traced: Slot,
    pub specular: Slot,
    pub glossy_tiles: TileBuffers,
    pub glossy_list: Option<TileList>,
    pub glossy_count: u32,
    pub shown: Slot,
    /// In place of light that was not traced.
    pub nothing: Slot,
    pub sums: Slot,
    /// Of what is shown; `None` where nothing shines.
    pub mean_luminance: Option<f64>,
}

/// What a surface image was drawn from.
#[derive(Clone, Debug)]
pub(super) struct SeenBy {
    camera: OrbitCamera,
    size_px: [u32; 2],
    placed: Placed,
    emission: f64,
}

impl SeenBy {
    pub fn new(wanted: &Wanted) -> Self {
        let Wanted { camera, size_px, placed, .. } = wanted;
        Self { camera: *camera, size_px: *size_px, placed: placed.clone(), emission: emitted(wanted) }
    }

    pub fn is(&self, wanted: &Wanted) -> bool {
        self.camera == wanted.camera
            && self.size_px == wanted.size_px
            && self.emission == emitted(wanted)
            && self.placed.is(&wanted.placed)
    }
}

/// Nothing depends on it where nothing emits.
fn emitted(wanted: &Wanted) -> f64 {
    if wanted.facts.emissive_voxels > 0 { wanted.settings.lighting.emission } else { 0.0 }
}

impl SurfacesOnGpu {
    /// The image and its depth buffer, of this size.
    fn sized(&mut self, gpu: &Gpu, size_px: [u32; 2]) -> Result<(SurfaceImage, GpuTexture), GpuError> {
        match (&self.image, &self.depth) {
            (Some(image), Some(depth)) if image.size_px() == size_px => Ok((image.clone(), depth.clone())),
            _ => {
                let image = self.image.insert(SurfaceImage::new(gpu, size_px)?).clone();
                Ok((image, self.depth.insert(depth_buffer(gpu, size_px)?).clone()))
            }
        }
    }
}

impl Engine {
    pub(super) fn record_surface_image(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        self.invalidate_surfaces();
        let mut frame = Recorder::default();
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let (image, depth) = self.surfaces.sized(&self.gpu, wanted.size_px)?;
        let mesh = self.mesh.as_ref().ok_or_else(|| missing("mesh vertices"))?;
        let of_pose = (&*wanted.placed.pose, &wanted.placed.hidden);
        let to_camera = camera_from_world(&wanted.camera, &grid);
        let posed = PosedMesh::new(&self.gpu, mesh, &mut self.surfaces.matrices, of_pose, &to_camera)?;
        let seen = Seen { camera: &wanted.camera, grid: &grid, emission: wanted.settings.lighting.emission };
        draw::record(&self.gpu, &mut frame, &posed, seen, (&image, &depth));
        Ok(frame)
    }

    /// What surfaces emit, and what every light adds.
    pub(super) fn record_direct(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let lighting = &wanted.settings.lighting;
        let bytes = image_bytes(wanted.size_px);
        let direct = self.surfaces.direct.ensure(&self.gpu, "direct light of surfaces", bytes)?;
        let view = self.surface_view(wanted)?;
        let open = no_map(&self.gpu, &mut self.light.no_map)?;
        let lit = Lit { image: self.surface_image()?, view: &view, direct: &direct };
        emission::record(&self.gpu, &mut frame, &lit);
        for (number, light) in wanted.lights.iter().enumerate() {
            let light = LightParams::new(light, &grid, lighting.offset_voxels());
            match lighting.shadows {
                Shadows::March => direct_march::record(&self.gpu, &mut frame, &lit, &light, &self.lit_octree()?),
                Shadows::Off => direct::record(&self.gpu, &mut frame, &lit, &light, &open),
                Shadows::Map => {
                    let map = self.light.maps.get(number).unwrap_or(&open);
                    direct::record(&self.gpu, &mut frame, &lit, &light, map);
                }
            }
        }
        Ok(frame)
    }

    pub(super) fn surface_image(&self) -> Result<&SurfaceImage, EngineError> {
        Ok(self.surfaces.image.as_ref().ok_or_else(|| missing("surface image"))?)
    }

    /// Rays of the surface image's pixels.
    pub(super) fn surface_view(&self, wanted: &Wanted) -> Result<ViewParams, EngineError> {
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        Ok(ViewParams::new(&PixelRays::new(&wanted.camera, &grid, wanted.size_px), &wanted.settings.look, grid.depth))
    }

    /// What the view asks for, in linear light.
    pub(super) fn record_composed(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let shown = self.surfaces.shown.ensure(&self.gpu, "shown light", image_bytes(wanted.size_px))?;
        self.surfaces.nothing.ensure(&self.gpu, "no light", RADIANCE_BYTES)?;
        self.composed(wanted, wanted.settings.look.surface, &shown)
    }

    fn composed(&self, wanted: &Wanted, surface: SurfaceView, shown: &GpuBuffer) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let view = self.surface_view(wanted)?;
        let asked = wanted.cones_asked();
        let params = ComposeParams {
            sky: wanted.sky_nits(),
            glossy_roughness: wanted.settings.cone_tracing.glossy_roughness as f32,
            span: self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid.span as f32,
            pad: 0,
            pad_end: [0; 2],
        };
        let made = |slot: &Slot, is_made: bool| slot.get().filter(|_| is_made).cloned();
        let direct = made(&self.surfaces.direct, self.done.direct.is_some());
        let diffuse = made(&self.surfaces.diffuse, self.done.diffuse.is_some());
        let specular = made(&self.surfaces.specular, self.done.specular.is_some() && asked.specular.is_ok());
        let terms = Terms {
            direct: direct.as_ref(),
            diffuse: diffuse.as_ref(),
            specular: specular.as_ref(),
            nothing: &self.surfaces.nothing.made("no light")?,
        };
        compose::record(&self.gpu, &mut frame, self.surface_image()?, (&view, &params), (surface, terms), shown);
        Ok(frame)
    }

    /// A part of the finished frame, as [`Self::read_surfaces`] gives what is shown; `None` where that frame
    /// did not make it. Blocks until it is here.
    pub fn read_surface_part(&self, part: SurfaceView) -> Result<Option<Vec<[f32; 4]>>, EngineError> {
        let Some(wanted) = self.wanted.as_ref().filter(|wanted| wanted.shows_surfaces()) else { return Ok(None) };
        let is_made = match part {
            SurfaceView::Final => wanted.settings.look.surface == SurfaceView::Final,
            SurfaceView::Direct => self.done.direct.is_some(),
            SurfaceView::Diffuse | SurfaceView::Irradiance | SurfaceView::Ao => self.done.diffuse.is_some(),
            SurfaceView::Specular => self.done.specular.is_some() || self.done.diffuse.is_some(),
            _ => self.done.surfaces.is_some(),
        };
        if !is_made || part == SurfaceView::Ao && wanted.cones_asked().occlusion.is_err() {
            return Ok(None);
        }
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let shown = self.gpu.buffer("a part of shown light", image_bytes(wanted.size_px), usage)?;
        Job::new(self.composed(wanted, part, &shown)?).run_to_end(&self.gpu)?;
        Ok(Some(self.gpu.read(&shown, 0..shown.bytes())?))
    }

    pub(super) fn record_luminance(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let shown = self.surfaces.shown.made("shown light")?;
        let sums = self.surfaces.sums.ensure(&self.gpu, "sums of luminance", SUM_BYTES)?;
        let pixels = wanted.size_px[0] * wanted.size_px[1];
        sum_luminance::record(&self.gpu, &mut frame, pixels, &shown, &sums);
        Ok(frame)
    }

    /// What shown surfaces are multiplied by.
    pub(super) fn surface_exposure(&self, wanted: &Wanted) -> f64 {
        match (wanted.settings.look.exposure_stops, self.surfaces.mean_luminance) {
            (Some(stops), _) => stops.exp2(),
            (None, Some(mean)) => crate::stages::view::MEAN_SHOWN_AS / mean,
            (None, None) => 1.0,
        }
    }

    pub(super) fn record_surfaces(
        &mut self,
        frame: &mut Recorder,
        wanted: &Wanted,
        picture: &Picture,
    ) -> Result<(), EngineError> {
        let look = &wanted.settings.look;
        let view = self.surface_view(wanted)?;
        let shown = self.surfaces.shown.made("shown light")?;
        let [least, most] = self.depth_range(wanted)?;
        let params = ShowSurfacesParams {
            least: least as f32,
            most: most as f32,
            sky: u32::from(wanted.settings.lighting.sky_nits != [0.0; 3]),
            pad: 0,
        };
        let exposure = ShownExposure::Set(self.surface_exposure(wanted));
        let palette = Palette::new(ColorBy::Occupancy);
        let seen = (self.surface_image()?, &shown);
        show_surfaces::record(
            &self.gpu,
            frame,
            seen,
            (look.surface, look.tone_curve, exposure),
            (&view, &palette, &params),
            picture,
        );
        Ok(())
    }

    /// From the eye to the farthest corner of the grid, scene units.
    pub(super) fn depth_range(&self, wanted: &Wanted) -> Result<[f64; 2], EngineError> {
        let grid = self.prepared.as_ref().ok_or(EngineError::NoScene)?.grid;
        let extent = f64::from(grid.cells()) * grid.span;
        let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|far| f64::from(far) * extent));
        let distances =
            corners.map(|corner| (grid.corner() + glam::DVec3::from_array(corner)).distance(wanted.camera.eye));
        Ok([0.0, distances.fold(0.0, f64::max)])
    }

    /// What the view of surfaces shows, in linear light: four f32 a pixel, rows from the top, the last 1 where a
    /// surface is. Radiance in nits, irradiance in lux, depth in scene units, normals in world axes. Blocks
    /// until it is here; `None` where another view is shown.
    pub fn read_surfaces(&self) -> Result<Option<Vec<[f32; 4]>>, EngineError> {
        let Some(wanted) = self.wanted.as_ref().filter(|wanted| wanted.shows_surfaces()) else { return Ok(None) };
        let shown = self.surfaces.shown.made("shown light")?;
        Ok(Some(self.gpu.read(&shown, 0..image_bytes(wanted.size_px))?))
    }
}
