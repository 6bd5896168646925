//! Rules of the passes that light the octree. Nobody looks at light, or there is none: no pass, no buffer.

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
    let dark = (!emits(scene, lighting)).then_some("nothing emits");
    let emission = unless(store.or(dark), rebuilt || changed.emission, "voxels moved", "voxels unchanged");
    plan.push(Pass::GatherEmission, emission);
    plan.push(Pass::DrawShadows, draw_shadows(scene, changed, settings, store));
    plan.push(Pass::Illuminate, again((scene.lights == 0).then_some("no light in the scene")));
    plan.push(Pass::GatherSky, again((!has_sky(lighting)).then_some("the sky is black")));
    plan.push(Pass::InjectLight, again(None));
    plan.push(Pass::AverageLight, again(None));
    let no_bounce = (lighting.bounces == 0).then_some("no bounces are asked for");
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

fn is_lit(scene: &SceneFacts, lighting: &Lighting) -> bool {
    scene.lights > 0 || has_sky(lighting) || emits(scene, lighting)
}

/// Why the octree keeps no light, if so. Slices sample opacity from the same store.
pub(super) fn store_skipped(scene: &SceneFacts, settings: &Settings) -> Option<&'static str> {
    let look = &settings.look;
    let is_sliced = look.view == View::Slice;
    let shows_light = look.view == View::Voxels && look.color.is_light();
    octree_wanted(scene, settings)
        .or((!is_sliced && !shows_light).then_some("light is not looked at"))
        .or((!is_sliced && !is_lit(scene, &settings.lighting)).then_some("no light and no emission"))
}

fn link(scene: &SceneFacts, changed: &Changes, settings: &Settings, rebuilt: bool) -> Verdict {
    let look = &settings.look;
    let hops = look.view == View::Slice && look.slice.lookup != Lookup::Ranks;
    let skip =
        octree_wanted(scene, settings).or((!hops && !look.pointers).then_some("no pointer is followed or shown"));
    unless(skip, rebuilt || changed.links, "pointers are followed or shown", "voxels unchanged")
}

fn draw_shadows(scene: &SceneFacts, changed: &Changes, settings: &Settings, store: Option<&'static str>) -> Verdict {
    let is_shown = settings.look.view == View::ShadowMap;
    let unmapped = match settings.lighting.shadows {
        _ if is_shown => None,
        Shadows::Map => store,
        Shadows::March => store.or(Some("shadows are marched")),
        Shadows::Off => store.or(Some("shadows are off")),
    };
    let skip = unmapped
        .or((scene.lights == 0).then_some("no light in the scene"))
        .or((scene.triangles == 0).then_some("no triangles"));
    unless(skip, changed.shadow_maps, "a light or an object moved", "lights and objects unmoved")
}
