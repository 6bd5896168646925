//! What is told of a frame: taken down when it is finished, before the next one overwrites what it was made of.

use super::super::parts::composed::Exposure;
use super::super::parts::cones::GlossyTiles;
use super::super::parts::light::{Irradiance, Light};
use super::super::reports::Results;
use super::super::request::Request;
use super::super::{Engine, PassTiming};
use crate::color::luminance;
use crate::plan::{Keys, Part, light_shown, tells_mean_light};
use crate::settings::{SurfaceView, View};
use crate::stages::pixels::MEAN_SHOWN_AS;
use crate::stages::view::slice;

impl Engine {
    /// Of a frame that has just been finished, by the keys of its methods.
    pub(in crate::engine) fn results(&self, request: &Request, methods: &[Keys]) -> Results {
        let nothing = Keys::default();
        let keys = methods.first().unwrap_or(&nothing);
        let tiles = self.parts.finished::<GlossyTiles>(keys).and_then(|tiles| tiles.count);
        Results {
            octree: self.report_octree(request, keys),
            accuracy: self.report_accuracy(request, methods),
            timings: self.times_of(methods),
            exposure: self.exposure_of(request, keys),
            value_range: self.range_of(request, keys),
            glossy_tiles: tiles.unwrap_or(0),
        }
    }

    fn times_of(&self, methods: &[Keys]) -> Vec<PassTiming> {
        let others = methods.iter().skip(1);
        let comparisons = others.filter_map(|keys| Some((Part::Comparison, keys.get(Part::Comparison)?)));
        let parts = methods.first().into_iter().flat_map(Keys::iter).chain(comparisons);
        parts.flat_map(|(part, key)| self.parts.timings(part, key)).cloned().collect()
    }

    fn exposure_of(&self, request: &Request, keys: &Keys) -> f64 {
        let look = &request.settings().method.look;
        let measured = || Some(self.parts.finished::<Exposure>(keys)?.measured.factor);
        match look.exposure_stops {
            Some(stops) => stops.exp2(),
            None if look.view == View::Surfaces => measured().map_or(1.0, f64::from),
            None => self.mean_light(request, keys).map_or(1.0, |mean| MEAN_SHOWN_AS / mean),
        }
    }

    /// Luminance of the scene's mean light, of the kind that the view shows; `None` where there is none, or the view
    /// reads opacity alone, whatever light was stored beside it before.
    fn mean_light(&self, request: &Request, keys: &Keys) -> Option<f64> {
        let asked = &request.shown().asked;
        if !tells_mean_light(asked) {
            return None;
        }
        let [r, g, b, opacity] = match light_shown(asked) {
            Part::Irradiance => self.parts.finished::<Irradiance>(keys)?.root,
            _ => self.parts.finished::<Light>(keys)?.root,
        };
        let mean = luminance([r, g, b].map(f64::from)) / f64::from(opacity);
        (opacity > 0.0 && mean > 0.0).then_some(mean)
    }

    fn range_of(&self, request: &Request, keys: &Keys) -> Option<[f64; 2]> {
        let look = &request.settings().method.look;
        match look.view {
            View::Slice => Some(slice::range_of_mean(&look.slice, self.mean_light(request, keys))),
            View::ShadowMap => {
                let maps = &request.shown().shadow_maps.maps;
                let map = maps.get(look.shadow_map).or(maps.last())?;
                Some(map.range_cells(request.grid().cells()).map(|cells| cells * request.grid().span))
            }
            View::Surfaces if look.surface == SurfaceView::Depth => Some(request.depth_range()),
            View::Voxels | View::Mesh | View::Ghost | View::Surfaces => None,
        }
    }
}
