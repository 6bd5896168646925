//! The shadow maps of a frame: one a light, drawn again where a light or an object moved.

use super::wanted::{Placed, Wanted};
use super::{Engine, EngineError, missing};
use crate::gpu::Recorder;
use crate::prepare::Prepared;
use crate::scene::Aabb;
use crate::settings::MotionSettings;
use crate::stages::light::shadow::{ShadowMap, ShadowParams};
use crate::stages::mesh::PosedMesh;

/// Texels that all shadow maps have together at most: 256 MiB. More lights get smaller maps.
const MAX_SHADOW_TEXELS: u64 = 1 << 26;

/// What the shadow maps were drawn from.
#[derive(Clone, Debug)]
pub(super) struct ShadowedBy {
    params: Vec<ShadowParams>,
    placed: Placed,
}

impl ShadowedBy {
    pub fn is(&self, other: &Self) -> bool {
        self.params == other.params && self.placed.is(&other.placed)
    }
}

/// One layout a light, all together within [`MAX_SHADOW_TEXELS`].
pub fn shadow_params(prepared: &Prepared, wanted: &Wanted) -> Vec<ShadowParams> {
    let bounds = prepared.bounds.map(|bounds| turned(bounds, &wanted.settings.motion));
    let sized = |size_px: u32| -> Vec<ShadowParams> {
        wanted.lights.iter().map(|light| ShadowParams::new(light, &prepared.grid, bounds, size_px)).collect()
    };
    let texels = |params: &[ShadowParams]| -> u64 {
        params.iter().map(|map| u64::from(map.count) * u64::from(map.size_px).pow(2)).sum()
    };
    let mut size_px = wanted.settings.lighting.shadow_map_px;
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

impl Engine {
    pub(super) fn shadowed_by(&self, wanted: &Wanted) -> Option<ShadowedBy> {
        let params = shadow_params(self.prepared.as_ref()?, wanted);
        Some(ShadowedBy { params, placed: wanted.placed.clone() })
    }

    pub(super) fn shadows_changed(&self, wanted: &Wanted) -> bool {
        match (&self.done.shadows, self.shadowed_by(wanted)) {
            (Some(done), Some(wanted)) => !done.is(&wanted),
            _ => true,
        }
    }

    /// A map of every light, kept until a light or an object moves.
    pub(super) fn record_shadows(&mut self, wanted: &Wanted) -> Result<Recorder, EngineError> {
        let mut frame = Recorder::default();
        let prepared = self.prepared.clone().ok_or(EngineError::NoScene)?;
        let mesh = self.mesh.as_ref().ok_or_else(|| missing("mesh vertices"))?;
        let params = shadow_params(&prepared, wanted);
        let of_pose = (&*wanted.placed.pose, &wanted.placed.hidden);
        let to_grid = prepared.grid.grid_from_world();
        let posed = PosedMesh::new(&self.gpu, mesh, &mut self.light.matrices, of_pose, &to_grid)?;
        let kept = self.light.maps.iter().map(|map| (map.params.count, map.params.size_px));
        if !kept.eq(params.iter().map(|params| (params.count, params.size_px))) {
            // The old ones go first: both at once might not fit.
            self.light.maps.clear();
            for params in &params {
                self.light.maps.push(ShadowMap::new(&self.gpu, *params)?);
            }
        }
        for (map, params) in self.light.maps.iter_mut().zip(params) {
            map.params = params;
            map.record(&self.gpu, &mut frame, &posed);
        }
        Ok(frame)
    }
}
