//! Rules of the picture, and of what moved voxels are compared with.

use serde::Serialize;

use super::effects::only_opacity;
use super::keys::{Keys, Wanted};
use super::light::store_skipped;
use super::voxels::{followed, from_octree, lookup, octree_skipped, unless};
use super::{Asked, Key, KeyBuilder, Part, Pass, WantedFor};
use crate::settings::{AlphaRule, ColorBy, Look, Slice, SliceValue, SurfaceView, ToneCurve, View};

const UNKNOWN_EXACT: &str = "the exact voxels of this pose are not made yet";

pub(super) fn exact_bits(asked: &Asked) -> Wanted {
    unless(octree_skipped(asked))?;
    let is_read = asked.compares() || asked.shows(View::Ghost);
    unless((!is_read).then_some("accuracy is not looked at"))?;
    let exact = asked.contents.exact.ok_or(UNKNOWN_EXACT)?;
    Ok(Key::of(Part::ExactBits).digest("new exact voxels", exact).build())
}

pub(super) fn exact_masks(asked: &Asked, keys: &Keys) -> Wanted {
    unless(octree_skipped(asked))?;
    unless((!asked.shows(View::Ghost)).then_some("another view is shown"))?;
    let bits = keys.wanted(Part::ExactBits)?;
    Ok(Key::of(Part::ExactMasks).input("new exact voxels", Part::ExactBits, bits).build())
}

pub(super) fn comparison(asked: &Asked, keys: &Keys) -> Wanted {
    unless(octree_skipped(asked))?;
    unless((!asked.compares()).then_some("accuracy is not looked at"))?;
    let key = Key::of(Part::Comparison).input("voxels changed", Part::Masks, keys.wanted(Part::Masks)?);
    Ok(key.input("new exact voxels", Part::ExactBits, keys.wanted(Part::ExactBits)?).build())
}

/// The voxels are drawn in the light that the octree holds.
pub fn shows_light(asked: &Asked) -> bool {
    asked.shows(View::Voxels) && asked.settings.method.look.color.is_light() && store_skipped(asked).is_none()
}

/// What draws the picture.
fn drawn_by(asked: &Asked) -> Pass {
    match asked.settings.method.look.view {
        View::Voxels if shows_light(asked) => Pass::MarchLight,
        View::Voxels => Pass::MarchVoxels,
        View::Mesh => Pass::DrawMesh,
        View::Ghost => Pass::MarchGhost,
        View::Slice => Pass::SliceOctree,
        View::ShadowMap => Pass::ShowShadowMap,
        View::Surfaces => Pass::ShowSurfaces,
    }
}

/// Why a pass does not draw the picture, if so.
pub(super) fn not_drawn_by(pass: Pass, asked: &Asked) -> Option<&'static str> {
    let elsewhere =
        (drawn_by(asked) != pass || asked.wanted_for != WantedFor::Picture).then_some("another view is shown");
    let octree = octree_skipped(asked);
    let bare = (asked.scene.triangles == 0).then_some("no triangles");
    let view = asked.settings.method.look.view;
    match pass {
        Pass::MarchVoxels => {
            octree.or((view == View::Voxels && elsewhere.is_some()).then_some("light is shown")).or(elsewhere)
        }
        Pass::MarchLight => octree
            .or((view != View::Voxels || !asked.settings.method.look.color.is_light())
                .then_some("colour is not by light"))
            .or(store_skipped(asked))
            .or(elsewhere),
        Pass::SliceOctree => octree.or(elsewhere),
        Pass::MarchGhost => octree.or(elsewhere).or(asked.contents.exact.is_none().then_some(UNKNOWN_EXACT)),
        Pass::ShowShadowMap => elsewhere.or((asked.scene.lights == 0).then_some("no light in the scene")).or(bare),
        Pass::DrawMesh => bare.or(elsewhere),
        _ => elsewhere.or(bare),
    }
}

/// What of the look any picture depends on.
#[derive(Serialize)]
struct LookOfPicture {
    view: View,
    color: ColorBy,
    level: Option<u32>,
    alpha: AlphaRule,
    voxel_edges: bool,
    shaded: bool,
    exposure_stops: Option<f64>,
    tone_curve: ToneCurve,
    slice: Slice,
    surface: SurfaceView,
    shadow_map: usize,
}

impl LookOfPicture {
    /// All of it but what is measured, linked, or in the camera's digest.
    fn of(look: &Look) -> Self {
        let Look { view, color, level, alpha, voxel_edges, shaded, exposure_stops, .. } = *look;
        let Look { tone_curve, slice, surface, shadow_map, .. } = *look;
        Self { view, color, level, alpha, voxel_edges, shaded, exposure_stops, tone_curve, slice, surface, shadow_map }
    }
}

pub(super) fn picture(asked: &Asked, keys: &Keys) -> Wanted {
    let pass = drawn_by(asked);
    unless(not_drawn_by(pass, asked))?;
    let key = Key::of(Part::Picture).digest("the camera moved", asked.contents.camera);
    let key = key.shot("another size", &asked.scene.picture_px);
    let key = key.shot("another look", &LookOfPicture::of(&asked.settings.method.look));
    Ok(shown_parts(pass, asked, keys, key)?.build())
}

fn shown_parts(pass: Pass, asked: &Asked, keys: &Keys, key: KeyBuilder) -> Result<KeyBuilder, &'static str> {
    let part = |key: KeyBuilder, changed: &'static str, part: Part| Ok(key.input(changed, part, keys.wanted(part)?));
    match pass {
        Pass::MarchLight => part(from_octree(key, "voxels changed", keys)?, "light changed", light_shown(asked)),
        Pass::MarchVoxels => {
            let key = from_octree(key, "voxels changed", keys)?;
            Ok(match keys.get(Part::ObjectNumbers) {
                Some(numbers) => key.input("colour by object", Part::ObjectNumbers, numbers),
                None => key,
            })
        }
        Pass::MarchGhost => {
            let key = part(from_octree(key, "voxels changed", keys)?, "new exact voxels", Part::ExactBits)?;
            part(key, "new exact voxels", Part::ExactMasks)
        }
        Pass::SliceOctree => {
            let key = part(from_octree(key, "voxels changed", keys)?, "light changed", light_shown(asked))?;
            match followed(lookup(asked)) {
                Some(links) => part(key, "pointers are followed or shown", links),
                None => Ok(key),
            }
        }
        Pass::ShowShadowMap => part(key, "shadow map changed", Part::ShadowMaps),
        Pass::DrawMesh => Ok(key.digest("objects moved", asked.contents.placed)),
        _ => {
            let key = part(key, "surfaces changed", Part::SurfaceImage)?;
            let key = part(key, "a part of the picture is new", Part::ComposedLight)?;
            let key = key.method("the sky changed", &asked.settings.method.lighting.sky_nits);
            Ok(match keys.get(Part::Exposure) {
                Some(exposure) => key.input("another exposure", Part::Exposure, exposure),
                None => key,
            })
        }
    }
}

/// Which averaged light a view reads.
pub fn light_shown(asked: &Asked) -> Part {
    let look = &asked.settings.method.look;
    let is_irradiance = match look.view {
        View::Slice => look.slice.value == SliceValue::Irradiance,
        _ => look.color == ColorBy::Irradiance,
    };
    if is_irradiance { Part::Irradiance } else { Part::Light }
}

/// Exposure, or the scale of a slice, follow the mean of the light that is shown.
pub fn tells_mean_light(asked: &Asked) -> bool {
    shows_light(asked) || (asked.shows(View::Slice) && !only_opacity(asked))
}
