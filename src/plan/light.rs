//! Rules of the parts that light the octree. Nobody looks at light, or there is none: no part, no buffer.

use super::effects::{ConesAsked, emits, is_lit, only_opacity, shows_direct};
use super::keys::{Keys, Wanted};
use super::voxels::{from_octree, from_voxels, octree_skipped, unless};
use super::{Asked, Held, Key, Part, Pass, WantedFor};
use crate::settings::lighting::Shadows;
use crate::settings::{ColorBy, SliceValue, View};

const ONLY_OPACITY: &str = "only opacity is looked at";

/// Why the octree keeps no light, if so. Slices and cones sample opacity from the same store.
pub(super) fn store_skipped(asked: &Asked) -> Option<&'static str> {
    let look = &asked.settings.method.look;
    let unread = match look.view {
        _ if asked.wanted_for == WantedFor::Comparison => Some("light is not looked at"),
        View::Slice => None,
        View::Surfaces => (!ConesAsked::new(asked).any()).then_some("no cone is asked for"),
        View::Voxels if look.color.is_light() => (!is_lit(asked)).then_some("no light and no emission"),
        View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => Some("light is not looked at"),
    };
    octree_skipped(asked).or(unread)
}

fn dark(asked: &Asked) -> Option<&'static str> {
    only_opacity(asked).then_some(ONLY_OPACITY)
}

pub(super) fn emission(asked: &Asked, keys: &Keys) -> Wanted {
    unless(store_skipped(asked).or(dark(asked)).or((!emits(asked)).then_some("nothing emits")))?;
    Ok(from_voxels(from_octree(Key::of(Part::Emission), "voxels moved", keys)?, keys)?.build())
}

pub(super) fn shadow_maps(asked: &Asked) -> Wanted {
    let unread = if shows_direct(asked) { None } else { store_skipped(asked).or(dark(asked)) };
    let unmapped = match asked.settings.method.lighting.shadows {
        _ if asked.shows(View::ShadowMap) => None,
        Shadows::Map => unread,
        Shadows::March => unread.or(Some("shadows are marched")),
        Shadows::Off => unread.or(Some("shadows are off")),
    };
    let unlit = (asked.scene.lights == 0).then_some("no light in the scene");
    unless(unmapped.or(unlit).or((asked.scene.triangles == 0).then_some("no triangles")))?;
    let moved = "a light or an object moved";
    let key = Key::of(Part::ShadowMaps).digest(moved, asked.contents.shadow_maps);
    Ok(key.digest(moved, asked.contents.placed).build())
}

/// Somebody reads shadow maps, and something throws shadows.
pub fn makes_shadow_maps(asked: &Asked) -> bool {
    shadow_maps(asked).is_ok()
}

/// Where opacity is enough, the store of radiance serves too.
pub(super) fn light(asked: &Asked, keys: &Keys, held: &Held) -> Wanted {
    unless(store_skipped(asked))?;
    let with_radiance = radiance(asked, keys)?;
    if !only_opacity(asked) || held.holds(Part::Light, &with_radiance) {
        return Ok(with_radiance);
    }
    let key = from_octree(Key::of(Part::Light), "voxels moved", keys)?.method("light is looked at", &false);
    Ok(key.method("another opacity", &asked.settings.method.lighting.opacity).build())
}

fn radiance(asked: &Asked, keys: &Keys) -> Wanted {
    let lighting = &asked.settings.method.lighting;
    let changed = "lighting changed";
    let key = from_octree(Key::of(Part::Light), "voxels moved", keys)?.method("light is looked at", &true);
    let key = key.method("another opacity", &lighting.opacity).digest(changed, asked.contents.lights);
    let key = key.method("other shadows", &lighting.shadows);
    let key = match keys.get(Part::ShadowMaps).filter(|_| lighting.shadows == Shadows::Map) {
        Some(maps) => key.input("other shadows", Part::ShadowMaps, maps),
        None => key,
    };
    let key = match keys.get(Part::Emission) {
        Some(emission) => key.input(changed, Part::Emission, emission).method(changed, &lighting.emission),
        None => key,
    };
    let gathers = lighting.has_sky() || lighting.bounces > 0;
    let cones = gathers.then_some((lighting.sky_nits, lighting.bounces, lighting.cones, lighting.cone_degrees));
    Ok(key.method(changed, &cones).build())
}

pub(super) fn irradiance(asked: &Asked, keys: &Keys) -> Wanted {
    let look = &asked.settings.method.look;
    let is_looked_at = match look.view {
        View::Voxels => look.color == ColorBy::Irradiance,
        View::Slice => look.slice.value == SliceValue::Irradiance,
        View::Mesh | View::Ghost | View::ShadowMap | View::Surfaces => false,
    };
    let light = keys.wanted(Part::Light)?;
    unless((!is_looked_at).then_some("irradiance is not looked at"))?;
    let changed = "irradiance is looked at";
    Ok(from_octree(Key::of(Part::Irradiance), changed, keys)?.input(changed, Part::Light, light).build())
}

/// Why a pass of the light that is made is left out, if so.
pub(super) fn left_out(pass: Pass, asked: &Asked) -> Option<&'static str> {
    let lighting = &asked.settings.method.lighting;
    let because = |reason| dark(asked).or(reason);
    match pass {
        Pass::Illuminate => because((asked.scene.lights == 0).then_some("no light in the scene")),
        Pass::GatherSky => because((!lighting.has_sky()).then_some("the sky is black")),
        Pass::Bounces => because(
            (lighting.bounces == 0)
                .then_some("no bounces are asked for")
                .or((!is_lit(asked)).then_some("no light to bounce")),
        ),
        _ => None,
    }
}
