//! Which effects a view calls for, of all that could be simulated.

use super::Asked;
use crate::settings::lighting::Shadows;
use crate::settings::{SliceValue, SurfaceView, View};

/// What cones are asked for; otherwise why they are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConesAsked {
    /// Diffuse cones bring light.
    pub radiance: Result<(), &'static str>,
    /// Diffuse cones tell what is near.
    pub occlusion: Result<(), &'static str>,
    pub specular: Result<(), &'static str>,
}

impl ConesAsked {
    pub fn new(asked: &Asked) -> Self {
        let cones = &asked.settings.method.cone_tracing;
        let surface = asked.settings.method.look.surface;
        let ask = |reasons: &[(bool, &'static str)]| match reasons.iter().find(|(applies, _)| *applies) {
            Some((_, reason)) => Err(*reason),
            None => Ok(()),
        };
        let elsewhere = (!asked.shows(View::Surfaces), "another view is shown");
        let (with_diffuse, with_specular) = looked_at(surface);
        let dark = (!is_lit(asked), "no light and no emission");
        // With the light of other surfaces there is no need to guess what is occluded.
        let is_guessed = with_diffuse && cones.ambient_occlusion && !cones.diffuse;
        let is_shown = surface == SurfaceView::Ao;
        Self {
            radiance: ask(&[
                elsewhere,
                (!with_diffuse, "not looked at"),
                (!cones.diffuse, "diffuse cones are off"),
                dark,
            ]),
            occlusion: ask(&[
                elsewhere,
                (!is_guessed && !is_shown, "occlusion is not looked at"),
                (!is_shown && !asked.settings.method.lighting.has_sky(), "no sky to occlude"),
            ]),
            specular: ask(&[
                elsewhere,
                (!with_specular, "not looked at"),
                (!cones.specular, "the specular cone is off"),
                (!asked.scene.glossy, "no glossy surface in the scene"),
                dark,
            ]),
        }
    }

    /// Any cone of the surfaces, so that the octree must hold what they meet.
    pub fn any(&self) -> bool {
        self.radiance.is_ok() || self.occlusion.is_ok() || self.specular.is_ok()
    }

    /// One that brings light, not opacity alone.
    pub fn any_radiance(&self) -> bool {
        self.radiance.is_ok() || self.specular.is_ok()
    }

    pub(super) fn diffuse(&self) -> Result<(), &'static str> {
        self.radiance.or_else(|reason| self.occlusion.map_err(|_| reason))
    }
}

/// Whether a view shows what diffuse cones bring, and what specular ones do. Surfaces that are not glossy
/// reflect what their diffuse cones see.
fn looked_at(surface: SurfaceView) -> (bool, bool) {
    match surface {
        SurfaceView::Final | SurfaceView::Specular => (true, true),
        SurfaceView::Diffuse | SurfaceView::Irradiance => (true, false),
        _ => (false, false),
    }
}

/// Whether the view shows what lights send without a detour.
pub(super) fn shows_direct(asked: &Asked) -> bool {
    asked.shows(View::Surfaces)
        && matches!(asked.settings.method.look.surface, SurfaceView::Final | SurfaceView::Direct)
}

/// Light that surfaces get straight from lights asks the octree what is in between.
pub(super) fn marches_shadows(asked: &Asked) -> bool {
    asked.scene.lights > 0 && asked.settings.method.lighting.shadows == Shadows::March && shows_direct(asked)
}

pub(super) fn emits(asked: &Asked) -> bool {
    asked.scene.emissive_voxels > 0 && asked.settings.method.lighting.emission > 0.0
}

pub(super) fn is_lit(asked: &Asked) -> bool {
    asked.scene.lights > 0 || asked.settings.method.lighting.has_sky() || emits(asked)
}

/// The store is read for its opacity alone.
pub fn only_opacity(asked: &Asked) -> bool {
    match asked.settings.method.look.view {
        View::Slice => asked.settings.method.look.slice.value == SliceValue::Occupancy,
        View::Surfaces => !ConesAsked::new(asked).any_radiance(),
        View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => false,
    }
}
