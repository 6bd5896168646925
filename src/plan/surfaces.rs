//! Rules of the parts behind the view of lit surfaces: what is not looked at, or has nothing to bring, is not traced.

use super::keys::{Keys, Wanted};
use super::light::{has_sky, is_lit};
use super::voxels::{followed, from_octree, unless};
use super::{Asked, Key, KeyBuilder, Part, Pass};
use crate::settings::lighting::Shadows;
use crate::settings::{ConeTracing, SurfaceView, View};

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
        let cones = &asked.settings.cone_tracing;
        let surface = asked.settings.look.surface;
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
                (!is_shown && !has_sky(&asked.settings.lighting), "no sky to occlude"),
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
pub(super) fn shows_direct(asked: &Asked) -> bool {
    asked.shows(View::Surfaces) && matches!(asked.settings.look.surface, SurfaceView::Final | SurfaceView::Direct)
}

/// Light that surfaces get straight from lights asks the octree what is in between.
pub(super) fn marches_shadows(asked: &Asked) -> bool {
    asked.scene.lights > 0 && asked.settings.lighting.shadows == Shadows::March && shows_direct(asked)
}

fn absent(asked: &Asked) -> Option<&'static str> {
    (!asked.shows(View::Surfaces))
        .then_some("another view is shown")
        .or((asked.scene.triangles == 0).then_some("no triangles"))
}

pub(super) fn image(asked: &Asked) -> Wanted {
    unless(absent(asked))?;
    let key = Key::of(Part::SurfaceImage).digest("camera or objects moved", asked.contents.camera);
    let key = key.digest("camera or objects moved", asked.contents.placed);
    let key = key.shot("another size", &asked.scene.picture_px);
    // Nothing depends on it where nothing emits.
    let emission = (asked.scene.emissive_voxels > 0).then_some(asked.settings.lighting.emission);
    Ok(key.method("lighting changed", &emission).build())
}

fn from_image(part: Part, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    Ok(Key::of(part).input("surfaces changed", Part::SurfaceImage, keys.wanted(Part::SurfaceImage)?))
}

pub(super) fn direct(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_image(Part::DirectLight, keys)?;
    unless((!shows_direct(asked)).then_some("not looked at"))?;
    let (lighting, changed) = (&asked.settings.lighting, "lights or shadows changed");
    let key = key.digest(changed, asked.contents.lights).method(changed, &lighting.shadows);
    let is_lit = asked.scene.lights > 0;
    Ok(match lighting.shadows {
        Shadows::Map => match keys.get(Part::ShadowMaps) {
            Some(maps) => key.input(changed, Part::ShadowMaps, maps),
            None => key,
        },
        Shadows::March if is_lit => from_octree(key, changed, keys)?,
        Shadows::March | Shadows::Off => key,
    }
    .build())
}

/// What cones read: the surfaces, and the lit octree by the look-up that is set.
fn from_cones(part: Part, asked: &Asked, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    let key = from_image(part, keys)?;
    unless((asked.scene.voxels() == 0).then_some("no voxels in the grid"))?;
    Ok(key.method("the sky changed", &asked.settings.lighting.sky_nits))
}

fn through_octree(key: KeyBuilder, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    let changed = "light or cones changed";
    Ok(from_octree(key, changed, keys)?.input(changed, Part::Light, keys.wanted(Part::Light)?))
}

pub(super) fn diffuse(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_cones(Part::DiffuseLight, asked, keys)?;
    let cones = ConesAsked::new(asked);
    cones.diffuse()?;
    let changed = "light or cones changed";
    // What specular cones are set to does not matter.
    let ConeTracing { specular, glossy_roughness, .. } = ConeTracing::default();
    let set = ConeTracing { specular, glossy_roughness, ..asked.settings.cone_tracing };
    let key = key.method(changed, &set).method(changed, &(cones.radiance.is_ok(), cones.occlusion.is_ok()));
    let links = followed(set.lookup).and_then(|part| Some((part, keys.get(part)?)));
    let key = links.into_iter().fold(key, |key, (part, links)| key.input(changed, part, links));
    Ok(through_octree(key, keys)?.build())
}

pub(super) fn glossy_tiles(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_image(Part::GlossyTiles, keys)?;
    unless((asked.scene.voxels() == 0).then_some("no voxels in the grid"))?;
    ConesAsked::new(asked).specular?;
    let cones = &asked.settings.cone_tracing;
    Ok(key.method("light or cones changed", &(cones.indirect_px, cones.glossy_roughness)).build())
}

pub(super) fn specular(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_cones(Part::SpecularLight, asked, keys)?;
    let tiles = keys.wanted(Part::GlossyTiles)?;
    let changed = "light or cones changed";
    let set = &asked.settings.cone_tracing;
    let key = key.method(changed, &(set.start_voxels, set.step_diameters, set.sampling));
    Ok(through_octree(key, keys)?.input(changed, Part::GlossyTiles, tiles).build())
}

pub(super) fn composed(asked: &Asked, keys: &Keys) -> Wanted {
    let settings = &asked.settings;
    let changed = "a part of the picture is new";
    let terms = [Part::DirectLight, Part::DiffuseLight, Part::SpecularLight];
    let terms = terms.into_iter().filter_map(|part| Some((part, keys.get(part)?)));
    let key = terms.fold(from_image(Part::ComposedLight, keys)?, |key, (part, term)| key.input(changed, part, term));
    let key = key.method("another part of the light is shown", &settings.look.surface);
    Ok(key.method(changed, &(settings.lighting.sky_nits, settings.cone_tracing.glossy_roughness)).build())
}

pub(super) fn exposure(asked: &Asked, keys: &Keys) -> Wanted {
    let composed = keys.wanted(Part::ComposedLight)?;
    let look = &asked.settings.look;
    unless((!look.surface.is_light()).then_some("no light is shown"))?;
    unless(look.exposure_stops.map(|_| "the exposure is set"))?;
    Ok(Key::of(Part::Exposure).input("a part of the picture is new", Part::ComposedLight, composed).build())
}

/// Why a pass of a part that is made is left out, if so.
pub(super) fn left_out(pass: Pass, asked: &Asked) -> Option<&'static str> {
    let cones = &asked.settings.cone_tracing;
    let picture_px = asked.scene.picture_px;
    let unlit = (asked.scene.lights == 0).then_some("no light in the scene");
    let marches = asked.settings.lighting.shadows == Shadows::March;
    match pass {
        Pass::LightSurfaces => unlit.or(marches.then_some("shadows are marched")),
        Pass::LightByMarching => unlit.or((!marches).then_some("shadows are not marched")),
        Pass::BlurDiffuse => (cones.pattern_px == 1).then_some("every pixel has all its cones"),
        Pass::UpsampleDiffuse => {
            (cones.diffuse_size_px(picture_px) == picture_px).then_some("every pixel sends out cones")
        }
        Pass::UpsampleSpecular => {
            (cones.specular_size_px(picture_px) == picture_px).then_some("every pixel sends out its cone")
        }
        _ => None,
    }
}
