//! Pictures of light: on voxels, on a slice, and as a light sees the scene.

use super::steps::Stored;
use super::{Engine, EngineError, Wanted, missing};
use crate::gpu::Recorder;
use crate::settings::{ColorBy, Settings, SliceValue, SurfaceView, View};
use crate::stages::sample::SampledOctree;
use crate::stages::view::camera::PixelRays;
use crate::stages::view::march_light::Exposure;
use crate::stages::view::{MEAN_SHOWN_AS, Palette, Picture, ViewParams};
use crate::stages::view::{march_light, show_shadow, slice};

type Drawn<'a> = (&'a PixelRays, &'a Picture);

impl Engine {
    /// What light is multiplied by before it is shown; 1 where there is none.
    pub fn exposure(&self) -> f64 {
        let Some(wanted) = &self.wanted else { return 1.0 };
        if wanted.settings.look.view == View::Surfaces {
            return self.surface_exposure(wanted);
        }
        let mean = self.light.mean(stored(&wanted.settings));
        match wanted.settings.look.exposure_stops {
            Some(stops) => stops.exp2(),
            None if mean > 0.0 => MEAN_SHOWN_AS / mean,
            None => 1.0,
        }
    }

    /// Ends of the colour scale of a slice (nits, lux or 1), a shadow map or depths (scene units); `None` where
    /// another view is shown.
    pub fn value_range(&self) -> Option<[f64; 2]> {
        let wanted = self.wanted.as_ref()?;
        let look = &wanted.settings.look;
        match look.view {
            View::Slice => Some(self.slice_range(&wanted.settings)),
            View::ShadowMap => {
                let span = self.prepared.as_ref()?.grid.span;
                Some(self.shadow_range(wanted)?.map(|cells| cells * span))
            }
            View::Surfaces if look.surface == SurfaceView::Depth => self.depth_range(wanted).ok(),
            View::Voxels | View::Mesh | View::Ghost | View::Surfaces => None,
        }
    }

    /// Around the mean, where light spans many powers of two; from 0 where the scale is linear.
    fn slice_range(&self, settings: &Settings) -> [f64; 2] {
        let slice = &settings.look.slice;
        let stored = if slice.value == SliceValue::Irradiance { Stored::Irradiance } else { Stored::Radiance };
        slice::range_of_mean(slice, Some(self.light.mean(stored)).filter(|mean| *mean > 0.0))
    }

    /// Distances in the grid along the map's axis, cells.
    fn shadow_range(&self, wanted: &Wanted) -> Option<[f64; 2]> {
        let map = self.light.maps.get(wanted.settings.look.shadow_map.min(self.light.maps.len().checked_sub(1)?))?;
        let cells = f64::from(self.prepared.as_ref()?.grid.cells());
        let corners = (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { cells } else { 0.0 }));
        let frames = &map.params.frames[..map.params.count as usize];
        let distances = corners.flat_map(|corner| {
            frames.iter().map(move |frame| {
                let [x, y, z, w] = frame.distance.map(f64::from);
                x * corner[0] + y * corner[1] + z * corner[2] + w
            })
        });
        let (least, most) = distances.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
        let is_sun = frames.len() == 1 && frames[0].clip_from_grid[0][3] == 0.0;
        Some([if is_sun { least } else { 0.0 }, most])
    }

    pub(super) fn record_light_view(
        &mut self,
        frame: &mut Recorder,
        wanted: &Wanted,
        (rays, picture): Drawn<'_>,
    ) -> Result<(), EngineError> {
        let octree = self.lit_octree()?;
        let light = self.light.stored(stored(&wanted.settings)).made("light")?;
        let view = ViewParams::new(rays, &wanted.settings.look, octree.sizes.params.depth);
        let factor = wanted.settings.look.exposure_stops.map_or(Exposure::OfMean, |stops| Exposure::Set(stops.exp2()));
        march_light::record(&self.gpu, frame, &octree, (&light, factor), &view, picture);
        Ok(())
    }

    pub(super) fn record_slice(
        &mut self,
        frame: &mut Recorder,
        wanted: &Wanted,
        (rays, picture): Drawn<'_>,
    ) -> Result<(), EngineError> {
        let look = &wanted.settings.look;
        let octree = &self.shown;
        let light = self.light.stored(stored(&wanted.settings)).made("light")?;
        let sampled =
            SampledOctree::new(octree.octree()?, &light, look.slice.lookup, octree.pointers(look.slice.lookup))?;
        let view = ViewParams::new(rays, look, octree.params.depth);
        let palette = Palette::new(look.slice.value.color());
        slice::record(&self.gpu, frame, &sampled, (&look.slice, None), (&view, &palette), picture);
        Ok(())
    }

    pub(super) fn record_shadow_map(
        &mut self,
        frame: &mut Recorder,
        wanted: &Wanted,
        (rays, picture): Drawn<'_>,
    ) -> Result<(), EngineError> {
        let look = &wanted.settings.look;
        let last = self.light.maps.len().checked_sub(1).ok_or_else(|| missing("shadow map"))?;
        let range = self.shadow_range(wanted).ok_or_else(|| missing("shadow map"))?;
        let map = &self.light.maps[look.shadow_map.min(last)];
        let depth = wanted.settings.discretization.depth();
        let view = ViewParams::new(rays, look, depth);
        show_shadow::record(&self.gpu, frame, map, range, (&view, &Palette::new(ColorBy::Occupancy)), picture);
        Ok(())
    }
}

/// Which light a look shows.
fn stored(settings: &Settings) -> Stored {
    let look = &settings.look;
    let is_irradiance = match look.view {
        View::Slice => look.slice.value == SliceValue::Irradiance,
        _ => look.color == ColorBy::Irradiance,
    };
    if is_irradiance { Stored::Irradiance } else { Stored::Radiance }
}
