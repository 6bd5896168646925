//! The picture: which view draws it, from what.

use super::composed::{ComposedLight, Exposure};
use super::exact::{ExactBits, ExactMasks};
use super::light::{Irradiance, Light};
use super::links::pointers;
use super::object_numbers::ObjectNumbers;
use super::payload::octree;
use super::shadow_maps::ShadowMaps;
use super::surfaces::surface_image;
use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, GpuError, GpuTexture, Recorder};
use crate::plan::{Part, Pass, light_shown, shows_light};
use crate::settings::{ColorBy, Look, View};
use crate::stages::light::LitOctree;
use crate::stages::pixels::picture::depth_buffer;
use crate::stages::pixels::projection::camera_from_world;
use crate::stages::pixels::{Picture, shown_color};
use crate::stages::sample::SampledOctree;
use crate::stages::view::ghost::{self, LeafSet};
use crate::stages::view::march::{self, MarchedOctree};
use crate::stages::view::march_light;
use crate::stages::view::mesh::{self, MeshTarget, MeshView};
use crate::stages::view::show_surfaces::{self, ShowSurfacesParams, ShownExposure};
use crate::stages::view::{GHOST_COLORS, Palette, show_shadow, slice};

#[derive(Debug, Default)]
pub struct Drawn {
    pub picture: Option<Picture>,
    /// What triangles need beside it to hide one another.
    depth: Option<GpuTexture>,
    matrices: Slot,
}

type Recorded = Result<(), EngineError>;

impl Made for Drawn {
    const PART: Part = Part::Picture;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let size_px = making.request.shot.size_px;
        let picture = match self.picture.take().filter(|picture| picture.size_px() == size_px) {
            Some(picture) => picture,
            None => Picture::new(making.gpu, size_px)?,
        };
        let drawn = &picture;
        match making.method.settings().method.look.view {
            View::Voxels if shows_light(&making.method.asked) => draw_light(making, parts, frame, drawn),
            View::Voxels => draw_voxels(making, parts, frame, drawn),
            View::Ghost => draw_ghost(making, parts, frame, drawn),
            View::Mesh => self.mesh(making, parts, frame, drawn),
            View::Slice => draw_slice(making, parts, frame, drawn),
            View::ShadowMap => draw_shadow_map(making, parts, frame, drawn),
            View::Surfaces => draw_surfaces(making, parts, frame, drawn),
        }?;
        self.picture = Some(picture);
        Ok(None)
    }
}

impl Drawn {
    fn mesh(&mut self, making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
        let (gpu, shot, grid) = (making.gpu, &making.request.shot, making.request.grid());
        let depth = match self.depth.take().filter(|depth| depth.size_px() == shot.size_px) {
            Some(depth) => depth,
            None => depth_buffer(gpu, shot.size_px)?,
        };
        let posed = parts.posed_mesh(making, &mut self.matrices, &camera_from_world(&shot.camera, grid))?;
        let farthest = shot.farthest(&making.request.prepared);
        let seen = MeshView { camera: &shot.camera, grid, farthest, look: &making.method.settings().method.look };
        making.begin(frame, Pass::DrawMesh);
        mesh::record(gpu, frame, &posed, seen, MeshTarget { picture, depth: &depth });
        self.depth = Some(depth);
        Ok(())
    }
}

/// What light is multiplied by before it is shown.
fn exposure(look: &Look) -> march_light::Exposure {
    use march_light::Exposure;
    look.exposure_stops.map_or(Exposure::OfMean, |stops| Exposure::Set(stops.exp2()))
}

fn draw_voxels(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let objects = parts.get::<ObjectNumbers>(making.keys).and_then(|numbers| numbers.leaf_objects.get());
    let octree = MarchedOctree::new(octree(making, parts)?, objects)?;
    let look = &making.method.settings().method.look;
    let palette = Palette::new(shown_color(look, making.request.grid().depth));
    making.begin(frame, Pass::MarchVoxels);
    march::record(making.gpu, frame, &octree, (&making.view(), &palette), picture);
    Ok(())
}

fn draw_light(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let octree = LitOctree::new(octree(making, parts)?)?;
    let light = light_read(making, parts)?;
    let exposure = exposure(&making.method.settings().method.look);
    making.begin(frame, Pass::MarchLight);
    march_light::record(making.gpu, frame, &octree, (&light, exposure), &making.view(), picture);
    Ok(())
}

fn draw_ghost(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let octree = octree(making, parts)?;
    let set = |leaf_bits: &Slot, occupied: &Slot| -> Result<LeafSet, GpuError> {
        Ok(LeafSet { leaf_bits: leaf_bits.made("leaf bits")?, occupied: occupied.made("occupied masks")? })
    };
    let moved = set(&octree.masks.leaf_bits, &octree.masks.occupied)?;
    let bits = parts.made::<ExactBits>(making.keys)?;
    let masks = parts.made::<ExactMasks>(making.keys)?;
    let exact = set(&bits.bits, &masks.occupied)?;
    let leaves = Look { level: None, ..making.method.settings().method.look };
    let view = making.view_of(&leaves);
    making.begin(frame, Pass::MarchGhost);
    ghost::record(making.gpu, frame, octree.sizes, (&moved, &exact), (&view, &GHOST_COLORS), picture);
    Ok(())
}

fn draw_slice(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let look = &making.method.settings().method.look;
    let light = light_read(making, parts)?;
    let pointers = pointers(making, parts, look.slice.lookup);
    let sampled = SampledOctree::new(octree(making, parts)?, &light, look.slice.lookup, pointers.as_ref())?;
    let palette = Palette::new(look.slice.value.color());
    making.begin(frame, Pass::SliceOctree);
    slice::record(making.gpu, frame, &sampled, (&look.slice, None), (&making.view(), &palette), picture);
    Ok(())
}

fn draw_shadow_map(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let missing = || GpuError::Missing { label: "shadow map".to_owned() };
    let maps = &parts.made::<ShadowMaps>(making.keys)?.maps;
    let wanted = making.method.settings().method.look.shadow_map;
    let map = maps.get(wanted).or(maps.last()).ok_or_else(missing)?;
    let range = map.params.range_cells(making.request.grid().cells());
    let palette = Palette::new(ColorBy::Occupancy);
    making.begin(frame, Pass::ShowShadowMap);
    show_shadow::record(making.gpu, frame, map, range, (&making.view(), &palette), picture);
    Ok(())
}

fn draw_surfaces(making: &Making<'_>, parts: &Parts, frame: &mut Recorder, picture: &Picture) -> Recorded {
    let look = &making.method.settings().method.look;
    let composed = parts.made::<ComposedLight>(making.keys)?;
    let shown = composed.shown.made("shown light")?;
    let [least, most] = making.request.depth_range();
    let has_sky = making.method.settings().method.lighting.has_sky();
    let params = ShowSurfacesParams { least: least as f32, most: most as f32, sky: u32::from(has_sky), pad: 0 };
    let measured = parts.get::<Exposure>(making.keys).and_then(|measured| measured.exposure.get());
    let exposure = match (look.exposure_stops, measured) {
        (Some(stops), _) => ShownExposure::Set(stops.exp2()),
        (None, Some(buffer)) => ShownExposure::Measured(buffer),
        (None, None) => ShownExposure::Set(1.0),
    };
    let (view, palette) = (making.view(), Palette::new(ColorBy::Occupancy));
    let seen = (surface_image(making, parts)?, &shown);
    making.begin(frame, Pass::ShowSurfaces);
    let shown_as = (look.surface, look.tone_curve, exposure);
    show_surfaces::record(making.gpu, frame, seen, shown_as, (&view, &palette, &params), picture);
    Ok(())
}

/// The averaged light that the view reads.
fn light_read(making: &Making<'_>, parts: &Parts) -> Result<GpuBuffer, EngineError> {
    Ok(match light_shown(&making.method.asked) {
        Part::Irradiance => parts.made::<Irradiance>(making.keys)?.shown.made("shown irradiance")?,
        _ => parts.made::<Light>(making.keys)?.light.made("light")?,
    })
}
