//! Rules of the passes that light the octree. Nobody looks at light, or there is none: no pass, no buffer.

use super::surfaces::{ConesAsked, shows_direct};
use super::voxels::octree_wanted;
use super::{Changes, FramePlan, Pass, SceneFacts, Verdict, unless};
use crate::settings::lighting::{Lighting, Shadows};
use crate::settings::{ColorBy, Lookup, Settings, SliceValue, View};

/// The rows from neighbour pointers to averaged light; whether light is computed again.
pub(super) fn light(
    plan: &mut FramePlan,
    scene: &SceneFacts,
    changed: &Changes,
    settings: &Settings,
    rebuilt: bool,
) -> bool {
    let store = store_skipped(scene, settings);
    let lighting = &settings.lighting;
    let relit = store.is_none() && (rebuilt || changed.lighting);
    let again = |skip: Option<&'static str>| {
        let because = if rebuilt { "voxels moved" } else { "lighting changed" };
        unless(store.or(skip), relit, because, "lighting unchanged")
    };
    plan.push(Pass::LinkNodes, link(scene, changed, settings, rebuilt));
    let opacity = only_opacity(scene, settings).then_some("only opacity is looked at");
    let dark = opacity.or((!emits(scene, lighting)).then_some("nothing emits"));
    let emission = unless(store.or(dark), rebuilt || changed.emission, "voxels moved", "voxels unchanged");
    plan.push(Pass::GatherEmission, emission);
    plan.push(Pass::DrawShadows, draw_shadows(scene, changed, settings, store));
    plan.push(Pass::Illuminate, again(opacity.or((scene.lights == 0).then_some("no light in the scene"))));
    plan.push(Pass::GatherSky, again(opacity.or((!has_sky(lighting)).then_some("the sky is black"))));
    plan.push(Pass::InjectLight, again(None));
    plan.push(Pass::AverageLight, again(None));
    let no_bounce = opacity.or((lighting.bounces == 0).then_some("no bounces are asked for"));
    plan.push(Pass::Bounces, again(no_bounce.or((!is_lit(scene, lighting)).then_some("no light to bounce"))));
    let looked_at = match settings.look.view {
        View::Voxels => settings.look.color == ColorBy::Irradiance,
        View::Slice => settings.look.slice.value == SliceValue::Irradiance,
        View::Mesh | View::Ghost | View::ShadowMap | View::Surfaces => false,
    };
    let skip = store.or((!looked_at).then_some("irradiance is not looked at"));
    plan.push(
        Pass::AverageIrradiance,
        unless(skip, relit || changed.irradiance, "irradiance is looked at", "light unchanged"),
    );
    relit
}

pub(super) fn has_sky(lighting: &Lighting) -> bool {
    lighting.sky_nits.iter().any(|channel| *channel > 0.0)
}

fn emits(scene: &SceneFacts, lighting: &Lighting) -> bool {
    scene.emissive_voxels > 0 && lighting.emission > 0.0
}

pub(super) fn is_lit(scene: &SceneFacts, lighting: &Lighting) -> bool {
    scene.lights > 0 || has_sky(lighting) || emits(scene, lighting)
}

/// Why the octree keeps no light, if so. Slices and cones sample opacity from the same store.
pub(super) fn store_skipped(scene: &SceneFacts, settings: &Settings) -> Option<&'static str> {
    let look = &settings.look;
    let is_asked_for = match look.view {
        View::Slice => return octree_wanted(scene, settings),
        View::Voxels => look.color.is_light(),
        View::Surfaces => {
            let asked = ConesAsked::new(scene, settings);
            let idle = (!asked.any()).then_some("no cone is asked for");
            return octree_wanted(scene, settings).or(idle);
        }
        View::Mesh | View::Ghost | View::ShadowMap => false,
    };
    octree_wanted(scene, settings).or((!is_asked_for).then_some("light is not looked at")).or((!is_lit(
        scene,
        &settings.lighting,
    ))
    .then_some("no light and no emission"))
}

/// The store is read for its opacity alone.
pub fn only_opacity(scene: &SceneFacts, settings: &Settings) -> bool {
    match settings.look.view {
        View::Slice => settings.look.slice.value == SliceValue::Occupancy,
        View::Surfaces => !ConesAsked::new(scene, settings).any_radiance(),
        View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => false,
    }
}

fn link(scene: &SceneFacts, changed: &Changes, settings: &Settings, rebuilt: bool) -> Verdict {
    let look = &settings.look;
    let hops = match look.view {
        View::Slice => look.slice.lookup != Lookup::Ranks,
        View::Surfaces => settings.cone_tracing.lookup != Lookup::Ranks && ConesAsked::new(scene, settings).any(),
        View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => false,
    };
    let skip =
        octree_wanted(scene, settings).or((!hops && !look.pointers).then_some("no pointer is followed or shown"));
    unless(skip, rebuilt || changed.links, "pointers are followed or shown", "voxels unchanged")
}

fn draw_shadows(scene: &SceneFacts, changed: &Changes, settings: &Settings, store: Option<&'static str>) -> Verdict {
    let is_shown = settings.look.view == View::ShadowMap;
    let dark = only_opacity(scene, settings).then_some("only opacity is looked at");
    let unread = if shows_direct(settings) { None } else { store.or(dark) };
    let unmapped = match settings.lighting.shadows {
        _ if is_shown => None,
        Shadows::Map => unread,
        Shadows::March => unread.or(Some("shadows are marched")),
        Shadows::Off => unread.or(Some("shadows are off")),
    };
    let skip = unmapped
        .or((scene.lights == 0).then_some("no light in the scene"))
        .or((scene.triangles == 0).then_some("no triangles"));
    unless(skip, changed.shadow_maps, "a light or an object moved", "lights and objects unmoved")
}
