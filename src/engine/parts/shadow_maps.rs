//! The shadow maps of the lights: one a light, kept until a light or an object moves.

use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::{Gpu, GpuError, Recorder};
use crate::plan::{Part, Pass};
use crate::stages::light::shadow::{ShadowMap, ShadowParams};

#[derive(Debug, Default)]
pub struct ShadowMaps {
    /// One a light.
    pub maps: Vec<ShadowMap>,
    matrices: Slot,
}

impl Made for ShadowMaps {
    const PART: Part = Part::ShadowMaps;

    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, layouts) = (making.gpu, &making.method.shadow_maps.maps);
        let kept = self.maps.iter().map(|map| (map.params.count, map.params.size_px));
        if !kept.eq(layouts.iter().map(|params| (params.count, params.size_px))) {
            // The old ones go first: both at once might not fit.
            self.maps.clear();
            for params in layouts {
                self.maps.push(ShadowMap::new(gpu, *params)?);
            }
        }
        let to_grid = making.request.grid().grid_from_world();
        let posed = parts.posed_mesh(making, &mut self.matrices, &to_grid)?;
        making.begin(frame, Pass::DrawShadows);
        for (map, params) in self.maps.iter_mut().zip(layouts) {
            map.params = *params;
            map.record(gpu, frame, &posed);
        }
        Ok(None)
    }
}

/// The maps that light is hidden by; none where shadows are not mapped.
pub fn maps_read<'a>(making: &Making<'_>, parts: &'a Parts) -> &'a [ShadowMap] {
    parts.get::<ShadowMaps>(making.keys).map_or(&[], |maps| &maps.maps)
}

/// A map that hides nothing.
pub fn no_map(gpu: &Gpu, kept: &mut Option<ShadowMap>) -> Result<ShadowMap, GpuError> {
    match kept {
        Some(map) => Ok(map.clone()),
        None => Ok(kept.insert(ShadowMap::new(gpu, ShadowParams::default())?).clone()),
    }
}
