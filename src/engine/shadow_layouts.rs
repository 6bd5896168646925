//! How large the shadow maps of a request are.

use bytesize::ByteSize;

use crate::lights::PosedLight;
use crate::prepare::Prepared;
use crate::scene::Aabb;
use crate::settings::{MotionSettings, Settings};
use crate::stages::light::shadow::ShadowParams;

/// Texels that all shadow maps have together at most: 256 MiB. More lights get smaller maps.
const MAX_SHADOW_TEXELS: u64 = 1 << 26;
const TEXEL_BYTES: u64 = size_of::<f32>() as u64;

#[derive(Clone, Debug)]
pub struct ShadowLayouts {
    /// One a light, all together within [`MAX_SHADOW_TEXELS`].
    pub maps: Vec<ShadowParams>,
    /// They are smaller than asked for, a sentence.
    pub too_large: Option<String>,
}

impl ShadowLayouts {
    pub fn new(prepared: &Prepared, lights: &[PosedLight], settings: &Settings) -> Self {
        let bounds = prepared.reach.map(|bounds| turned(bounds, &settings.shot.motion));
        let sized = |size_px: u32| -> Vec<ShadowParams> {
            lights.iter().map(|light| ShadowParams::new(light, &prepared.grid, bounds, size_px)).collect()
        };
        let wanted_px = settings.method.lighting.shadow_map_px;
        let (mut size_px, mut maps) = (wanted_px, sized(wanted_px));
        let wanted_texels = texels(&maps);
        while size_px > 1 && texels(&maps) > MAX_SHADOW_TEXELS {
            size_px /= 2;
            maps = sized(size_px);
        }
        let too_large = (size_px < wanted_px).then(|| {
            let [wanted, most] = [wanted_texels, MAX_SHADOW_TEXELS].map(|texels| ByteSize(texels * TEXEL_BYTES));
            format!(
                "shadow maps of {wanted_px} texels along an edge would take {}, and all may take {} together: \
                 they have {size_px}",
                wanted.display().iec(),
                most.display().iec()
            )
        });
        Self { maps, too_large }
    }
}

fn texels(maps: &[ShadowParams]) -> u64 {
    maps.iter().map(|map| u64::from(map.count) * u64::from(map.size_px).pow(2)).sum()
}

/// Bounds of what turns about its centre, however it is turned.
fn turned(bounds: Aabb, motion: &MotionSettings) -> Aabb {
    if motion.turn_degrees == [0.0; 3] {
        return bounds;
    }
    let half = glam::DVec3::splat((bounds.max - bounds.min).length() / 2.0);
    Aabb { min: bounds.center() - half, max: bounds.center() + half }
}
