//! The shadow maps of the lights: one a light, kept until a light or an object moves.

use super::{Made, Making, Parts, Read};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::gpu::Recorder;
use crate::lights::PosedLight;
use crate::plan::Pass;
use crate::prepare::Prepared;
use crate::scene::Aabb;
use crate::settings::{MotionSettings, Settings};
use crate::stages::light::shadow::{ShadowMap, ShadowParams};

/// Texels that all shadow maps have together at most: 256 MiB. More lights get smaller maps.
const MAX_SHADOW_TEXELS: u64 = 1 << 26;

#[derive(Debug, Default)]
pub struct ShadowMaps {
    /// One a light.
    pub maps: Vec<ShadowMap>,
    matrices: Slot,
}

/// One layout a light, all together within [`MAX_SHADOW_TEXELS`].
pub fn layouts(prepared: &Prepared, lights: &[PosedLight], settings: &Settings) -> Vec<ShadowParams> {
    let bounds = prepared.bounds.map(|bounds| turned(bounds, &settings.motion));
    let sized = |size_px: u32| -> Vec<ShadowParams> {
        lights.iter().map(|light| ShadowParams::new(light, &prepared.grid, bounds, size_px)).collect()
    };
    let texels = |params: &[ShadowParams]| -> u64 {
        params.iter().map(|map| u64::from(map.count) * u64::from(map.size_px).pow(2)).sum()
    };
    let mut size_px = settings.lighting.shadow_map_px;
    let mut params = sized(size_px);
    while size_px > 1 && texels(&params) > MAX_SHADOW_TEXELS {
        size_px /= 2;
        params = sized(size_px);
    }
    params
}

/// Bounds of what turns about its centre, however it is turned.
fn turned(bounds: Aabb, motion: &MotionSettings) -> Aabb {
    if motion.turn_degrees == [0.0; 3] {
        return bounds;
    }
    let half = glam::DVec3::splat((bounds.max - bounds.min).length() / 2.0);
    Aabb { min: bounds.center() - half, max: bounds.center() + half }
}

impl Made for ShadowMaps {
    fn record(
        &mut self,
        making: &Making<'_>,
        parts: &Parts,
        frame: &mut Recorder,
    ) -> Result<Option<Read>, EngineError> {
        let (gpu, layouts) = (making.gpu, &making.method.shadow_maps);
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
