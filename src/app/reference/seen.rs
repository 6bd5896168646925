//! The picture that a reference is of: what the path tracer depends on, and nothing else.

use std::sync::Arc;

use crate::prepare::Prepared;
use crate::settings::{ConeTracing, Lighting, MethodSettings, Settings};

#[derive(Clone)]
pub struct Seen {
    pub prepared: Arc<Prepared>,
    pub settings: Settings,
    pub size_px: [u32; 2],
}

impl Seen {
    /// Whether paths see the same: whatever exposure, part, cones and voxels are.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.prepared, &other.prepared)
            && self.size_px == other.size_px
            && of_paths(&self.settings) == of_paths(&other.settings)
    }
}

/// The settings with everything unset that no path depends on. How many bounces voxels have decides which
/// paths count.
fn of_paths(settings: &Settings) -> Settings {
    let unset = Lighting::default();
    let bounces = settings.method.lighting.bounces.min(1);
    let method = MethodSettings {
        lighting: Lighting {
            shadows: unset.shadows,
            shadow_map_px: unset.shadow_map_px,
            shadow_offset_voxels: unset.shadow_offset_voxels,
            opacity: unset.opacity,
            bounces,
            cones: unset.cones,
            cone_degrees: unset.cone_degrees,
            ..settings.method.lighting.clone()
        },
        cone_tracing: ConeTracing {
            occlusion_distance: settings.method.cone_tracing.occlusion_distance,
            ..ConeTracing::default()
        },
        ..MethodSettings::default()
    };
    Settings { shot: settings.shot.clone(), method }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::{Look, SurfaceView, ToneCurve, View};

    #[test]
    fn cones_and_exposure_leave_paths_as_they_are() {
        let mut other = Settings::default();
        other.method.look = Look {
            view: View::Surfaces,
            surface: SurfaceView::Ao,
            exposure_stops: Some(3.0),
            tone_curve: ToneCurve::Linear,
            ..other.method.look
        };
        other.method.cone_tracing.cones = 9;
        other.method.lighting.cones = 9;
        other.method.discretization.dense_level = Some(3);
        assert_eq!(of_paths(&other), of_paths(&Settings::default()));
        other.method.cone_tracing.occlusion_distance = Some(1.0);
        assert_ne!(of_paths(&other), of_paths(&Settings::default()));
    }

    #[test]
    fn lights_and_pose_are_seen() {
        let mut sky = Settings::default();
        sky.method.lighting.sky_nits = [1.0; 3];
        let mut later = Settings::default();
        later.shot.motion.time_secs = 1.0;
        let mut bounced = Settings::default();
        bounced.method.lighting.bounces = 2;
        for other in [sky, later, bounced] {
            assert_ne!(of_paths(&other), of_paths(&Settings::default()));
        }
    }
}
