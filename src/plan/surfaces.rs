//! Rules of the passes behind the view of lit surfaces: what is not looked at, or has nothing to bring, is
//! not traced.

use super::light::{has_sky, is_lit};
use super::{Changes, FramePlan, Pass, SceneFacts, State, Verdict, unless};
use crate::settings::lighting::Shadows;
use crate::settings::{Settings, SurfaceView, View};

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
    pub fn new(scene: &SceneFacts, settings: &Settings) -> Self {
        let cones = &settings.cone_tracing;
        let surface = settings.look.surface;
        let ask = |reasons: &[(bool, &'static str)]| match reasons.iter().find(|(applies, _)| *applies) {
            Some((_, reason)) => Err(*reason),
            None => Ok(()),
        };
        let elsewhere = (settings.look.view != View::Surfaces, "another view is shown");
        let (with_diffuse, with_specular) = looked_at(surface);
        let dark = (!is_lit(scene, &settings.lighting), "no light and no emission");
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
                (!is_shown && !has_sky(&settings.lighting), "no sky to occlude"),
            ]),
            specular: ask(&[
                elsewhere,
                (!with_specular, "not looked at"),
                (!cones.specular, "the specular cone is off"),
                (!scene.glossy, "no glossy surface in the scene"),
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

    fn diffuse(&self) -> Result<(), &'static str> {
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
pub(super) fn shows_direct(settings: &Settings) -> bool {
    let surface = settings.look.surface;
    settings.look.view == View::Surfaces && matches!(surface, SurfaceView::Final | SurfaceView::Direct)
}

/// Light that surfaces get straight from lights asks the octree what is in between.
pub(super) fn marches_shadows(scene: &SceneFacts, settings: &Settings) -> bool {
    scene.lights > 0 && settings.lighting.shadows == Shadows::March && shows_direct(settings)
}

/// The rows from the surface image to its picture. `relit`: the octree's light is computed again; `rebuilt`:
/// the octree itself.
pub(super) fn surfaces(
    plan: &mut FramePlan,
    scene: &SceneFacts,
    changed: &Changes,
    settings: &Settings,
    (rebuilt, relit): (bool, bool),
) {
    let absent = (settings.look.view != View::Surfaces)
        .then_some("another view is shown")
        .or((scene.triangles == 0).then_some("no triangles"));
    let redrawn = absent.is_none() && changed.surfaces;
    plan.push(Pass::DrawSurfaces, unless(absent, redrawn, "camera or objects moved", "camera and objects unmoved"));
    direct(plan, scene, changed, settings, (absent, redrawn, rebuilt));
    cones(plan, scene, changed, settings, (absent, redrawn, relit));
    let fresh = changed.view || plan.rows.iter().any(|row| OF_PICTURE.contains(&row.pass) && row.state == State::Run);
    plan.push(Pass::ComposeSurfaces, unless(absent, fresh, "a part of the picture is new", "nothing changed"));
    let unexposed = absent
        .or((!settings.look.surface.is_light()).then_some("no light is shown"))
        .or(settings.look.exposure_stops.map(|_| "the exposure is set"));
    plan.push(Pass::MeasureExposure, unless(unexposed, fresh, "a part of the picture is new", "nothing changed"));
    plan.push(Pass::ShowSurfaces, unless(absent, fresh, "a part of the picture is new", "nothing changed"));
}

/// What runs with anything that the picture is composed of.
const OF_PICTURE: [Pass; 4] = [Pass::DrawSurfaces, Pass::EmitSurfaces, Pass::TraceDiffuse, Pass::TraceSpecular];

fn direct(
    plan: &mut FramePlan,
    scene: &SceneFacts,
    changed: &Changes,
    settings: &Settings,
    (absent, redrawn, rebuilt): (Option<&'static str>, bool, bool),
) {
    let unseen = absent.or((!shows_direct(settings)).then_some("not looked at"));
    let marches = settings.lighting.shadows == Shadows::March;
    let lit = redrawn || changed.direct || plan.runs(Pass::DrawShadows) || rebuilt && marches;
    let because = if redrawn { "surfaces changed" } else { "lights or shadows changed" };
    let verdict = |skip: Option<&'static str>| unless(unseen.or(skip), lit, because, "lights and surfaces unchanged");
    let unlit = (scene.lights == 0).then_some("no light in the scene");
    plan.push(Pass::EmitSurfaces, verdict(None));
    plan.push(Pass::LightSurfaces, verdict(unlit.or(marches.then_some("shadows are marched"))));
    plan.push(Pass::LightByMarching, verdict(unlit.or((!marches).then_some("shadows are not marched"))));
}

fn cones(
    plan: &mut FramePlan,
    scene: &SceneFacts,
    changed: &Changes,
    settings: &Settings,
    (absent, redrawn, relit): (Option<&'static str>, bool, bool),
) {
    let asked = ConesAsked::new(scene, settings);
    let outside = absent.or((scene.voxels() == 0).then_some("no voxels in the grid"));
    let verdict = |skip: Option<&'static str>, changed: bool| -> Verdict {
        unless(outside.or(skip), redrawn || relit || changed, because(redrawn), "light and surfaces unchanged")
    };
    let diffuse = verdict(asked.diffuse().err(), changed.diffuse);
    plan.push(Pass::TraceDiffuse, diffuse);
    let whole = (!settings.cone_tracing.shares_diffuse()).then_some("every pixel has all its cones");
    plan.push(Pass::FilterDiffuse, verdict(asked.diffuse().err().or(whole), changed.diffuse));
    let specular = verdict(asked.specular.err(), changed.specular);
    plan.push(Pass::ListGlossyTiles, specular);
    plan.push(Pass::TraceSpecular, specular);
    let whole = (!settings.cone_tracing.shares_specular()).then_some("every pixel has its cone");
    plan.push(Pass::FilterSpecular, verdict(asked.specular.err().or(whole), changed.specular));
}

fn because(redrawn: bool) -> &'static str {
    if redrawn { "surfaces changed" } else { "light or cones changed" }
}
