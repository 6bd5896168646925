//! Rules of the parts behind the view of lit surfaces: what is not looked at, or has nothing to bring, is not traced.

use super::effects::{ConesAsked, shows_direct};
use super::keys::{Keys, Wanted};
use super::voxels::{followed, from_octree, unless};
use super::{Asked, Key, KeyBuilder, Part, Pass};
use crate::settings::lighting::Shadows;
use crate::settings::{ConeTracing, View};

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
    let emission = (asked.scene.emissive_voxels > 0).then_some(asked.settings.method.lighting.emission);
    Ok(key.method("lighting changed", &emission).build())
}

fn from_image(part: Part, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    Ok(Key::of(part).input("surfaces changed", Part::SurfaceImage, keys.wanted(Part::SurfaceImage)?))
}

pub(super) fn direct(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_image(Part::DirectLight, keys)?;
    unless((!shows_direct(asked)).then_some("not looked at"))?;
    let (lighting, changed) = (&asked.settings.method.lighting, "lights or shadows changed");
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
    Ok(key.method("the sky changed", &asked.settings.method.lighting.sky_nits))
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
    let set = ConeTracing { specular, glossy_roughness, ..asked.settings.method.cone_tracing };
    let key = key.method(changed, &set).method(changed, &(cones.radiance.is_ok(), cones.occlusion.is_ok()));
    let links = followed(set.lookup).and_then(|part| Some((part, keys.get(part)?)));
    let key = links.into_iter().fold(key, |key, (part, links)| key.input(changed, part, links));
    Ok(through_octree(key, keys)?.build())
}

pub(super) fn glossy_tiles(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_image(Part::GlossyTiles, keys)?;
    unless((asked.scene.voxels() == 0).then_some("no voxels in the grid"))?;
    ConesAsked::new(asked).specular?;
    let cones = &asked.settings.method.cone_tracing;
    Ok(key.method("light or cones changed", &(cones.indirect_px, cones.glossy_roughness)).build())
}

pub(super) fn specular(asked: &Asked, keys: &Keys) -> Wanted {
    let key = from_cones(Part::SpecularLight, asked, keys)?;
    let tiles = keys.wanted(Part::GlossyTiles)?;
    let changed = "light or cones changed";
    let set = &asked.settings.method.cone_tracing;
    let key = key.method(changed, &(set.start_voxels, set.step_diameters, set.sampling));
    Ok(through_octree(key, keys)?.input(changed, Part::GlossyTiles, tiles).build())
}

pub(super) fn composed(asked: &Asked, keys: &Keys) -> Wanted {
    let settings = &asked.settings;
    let changed = "a part of the picture is new";
    let terms = [Part::DirectLight, Part::DiffuseLight, Part::SpecularLight];
    let terms = terms.into_iter().filter_map(|part| Some((part, keys.get(part)?)));
    let key = terms.fold(from_image(Part::ComposedLight, keys)?, |key, (part, term)| key.input(changed, part, term));
    let key = key.method("another part of the light is shown", &settings.method.look.surface);
    Ok(key.method(changed, &(settings.method.lighting.sky_nits, settings.method.cone_tracing.glossy_roughness)).build())
}

pub(super) fn exposure(asked: &Asked, keys: &Keys) -> Wanted {
    let composed = keys.wanted(Part::ComposedLight)?;
    let look = &asked.settings.method.look;
    unless((!look.surface.is_light()).then_some("no light is shown"))?;
    unless(look.exposure_stops.map(|_| "the exposure is set"))?;
    Ok(Key::of(Part::Exposure).input("a part of the picture is new", Part::ComposedLight, composed).build())
}

/// Why a pass of a part that is made is left out, if so.
pub(super) fn left_out(pass: Pass, asked: &Asked) -> Option<&'static str> {
    let cones = &asked.settings.method.cone_tracing;
    let picture_px = asked.scene.picture_px;
    let unlit = (asked.scene.lights == 0).then_some("no light in the scene");
    let marches = asked.settings.method.lighting.shadows == Shadows::March;
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
