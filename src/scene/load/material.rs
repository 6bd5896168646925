//! Materials: metallic-roughness as it is, specular-glossiness converted.

use gltf::json::{
    self,
    extensions::texture::TextureTransform,
    material::{AlphaMode as FileAlphaMode, EmissiveFactor, NormalTexture},
    validation::Checked,
};

use super::{
    error::Defect,
    file_object::FileObject,
    source::Source,
    spec_gloss,
    texture::{Textures, overridden},
};
use crate::scene::{AlphaMode, Material, Warning};

pub(super) fn load(
    source: &Source,
    textures: &mut Textures,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Material>, Defect> {
    let materials = source.root.materials.iter().enumerate();
    materials.map(|(index, material)| load_one(source, index, material, textures, warnings)).collect()
}

fn load_one(
    source: &Source,
    index: usize,
    material: &json::Material,
    textures: &mut Textures,
    warnings: &mut Vec<Warning>,
) -> Result<Material, Defect> {
    let object = FileObject::item("material", index, material.name.as_deref());
    let extensions = material.extensions.as_ref();
    let pbr = &material.pbr_metallic_roughness;
    let emissive_texture = textures.slot(&object, material.emissive_texture.as_ref(), warnings);
    // An emission whose mask is lost would light up the whole surface.
    let emission_lost = material.emissive_texture.is_some() && emissive_texture.is_none();
    let declared_strength =
        extensions.and_then(|e| e.emissive_strength.as_ref()).map_or(1.0, |e| e.emissive_strength.0);
    let strength = if emission_lost { 0.0 } else { declared_strength };
    let normal = material.normal_texture.as_ref();
    let EmissiveFactor(emissive) = material.emissive_factor;
    let mut loaded = Material {
        name: material.name.clone().unwrap_or_else(|| format!("material {index}")),
        base_color: pbr.base_color_factor.0,
        base_color_texture: textures.slot(&object, pbr.base_color_texture.as_ref(), warnings),
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        metallic_roughness_texture: textures.slot(&object, pbr.metallic_roughness_texture.as_ref(), warnings),
        normal_scale: normal.map_or(1.0, |normal| normal.scale),
        normal_texture: normal.and_then(|normal| {
            let transform = normal_transform(normal, &object, warnings);
            textures.place(&object, normal.index.value(), normal.tex_coord, transform.as_ref(), warnings)
        }),
        emissive: emissive.map(|channel| channel * strength),
        emissive_texture,
        alpha_mode: alpha_mode(material, &object, warnings),
        double_sided: material.double_sided,
        unlit: extensions.is_some_and(|extensions| extensions.unlit.is_some()),
    };
    if let Some(declared) = extensions.and_then(|extensions| extensions.pbr_specular_glossiness.as_ref()) {
        spec_gloss::convert(source, &object, declared, textures, &mut loaded, warnings)
            .map_err(|cause| Defect::new(object.clone(), cause))?;
    }
    check(loaded, object)
}

fn alpha_mode(material: &json::Material, object: &FileObject, warnings: &mut Vec<Warning>) -> AlphaMode {
    match material.alpha_mode {
        Checked::Valid(FileAlphaMode::Opaque) => AlphaMode::Opaque,
        Checked::Valid(FileAlphaMode::Mask) => AlphaMode::Mask { cutoff: material.alpha_cutoff.unwrap_or_default().0 },
        Checked::Valid(FileAlphaMode::Blend) => AlphaMode::Blend,
        Checked::Invalid => {
            warnings.push(object.warning("its alpha mode is one that glTF does not know; it is shown opaque"));
            AlphaMode::Opaque
        }
    }
}

/// Which `TEXCOORD_n` a normal texture reads.
pub(super) fn normal_tex_coord_set(normal: &NormalTexture) -> u32 {
    let transform = declared_transform(normal).and_then(Result::ok);
    overridden(normal.tex_coord, transform.as_ref())
}

/// The typed document keeps this one extension of a normal texture untyped.
fn declared_transform(normal: &NormalTexture) -> Option<serde_json::Result<TextureTransform>> {
    let declared = normal.extensions.as_ref()?.others.get("KHR_texture_transform")?;
    Some(serde::Deserialize::deserialize(declared))
}

fn normal_transform(
    normal: &NormalTexture,
    object: &FileObject,
    warnings: &mut Vec<Warning>,
) -> Option<TextureTransform> {
    declared_transform(normal)?
        .map_err(|error| {
            warnings.push(object.warning(format!("the transform of its normal texture is ignored: {error}")))
        })
        .ok()
}

fn check(material: Material, object: FileObject) -> Result<Material, Defect> {
    let factors = [material.metallic, material.roughness, material.normal_scale];
    let mut numbers = factors.iter().chain(&material.base_color).chain(&material.emissive);
    if numbers.all(|number| number.is_finite()) {
        Ok(material)
    } else {
        Err(Defect::new(object, "has a factor that is not finite"))
    }
}
