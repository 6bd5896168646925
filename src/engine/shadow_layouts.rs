//! How large the shadow maps of a request are.

use crate::lights::PosedLight;
use crate::prepare::Prepared;
use crate::scene::Aabb;
use crate::settings::{MotionSettings, Settings};
use crate::stages::light::shadow::ShadowParams;

/// Texels that all shadow maps have together at most: 256 MiB. More lights get smaller maps.
const MAX_SHADOW_TEXELS: u64 = 1 << 26;

/// One layout a light, all together within [`MAX_SHADOW_TEXELS`].
pub fn layouts(prepared: &Prepared, lights: &[PosedLight], settings: &Settings) -> Vec<ShadowParams> {
    let bounds = prepared.bounds.map(|bounds| turned(bounds, &settings.shot.motion));
    let sized = |size_px: u32| -> Vec<ShadowParams> {
        lights.iter().map(|light| ShadowParams::new(light, &prepared.grid, bounds, size_px)).collect()
    };
    let texels = |params: &[ShadowParams]| -> u64 {
        params.iter().map(|map| u64::from(map.count) * u64::from(map.size_px).pow(2)).sum()
    };
    let mut size_px = settings.method.lighting.shadow_map_px;
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
