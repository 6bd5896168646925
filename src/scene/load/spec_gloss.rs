//! KHR_materials_pbrSpecularGlossiness as metallic-roughness: the conversion of the extension's
//! own appendix. A surface reflects its specular colour at normal incidence; what exceeds the 4 %
//! of a dielectric makes it metallic.
//!
//! For the diffuse brightness d, specular brightness s, one minus the strongest specular channel o
//! and metallic share m, base colour brightness b must give both colours:
//! d · o = b · (1 − s₀)(1 − m) and s = s₀(1 − m) + b · m, a quadratic equation in m.

use std::sync::Arc;

use gltf::json::extensions::material::PbrSpecularGlossiness;
use image::{Rgba, RgbaImage};

use super::{file_object::FileObject, source::Source, texture::Textures};
use crate::color::linear_from_gamma;
use crate::scene::{Material, Texture, Warning};

/// s₀: reflectance of a dielectric at normal incidence.
const DIELECTRIC: f32 = 0.04;
const SHORTEST: f32 = 1e-6;

/// Puts the converted values into `material`. Errors are causes.
pub(super) fn convert(
    source: &Source,
    object: &FileObject,
    declared: &PbrSpecularGlossiness,
    textures: &mut Textures,
    material: &mut Material,
    warnings: &mut Vec<Warning>,
) -> Result<(), String> {
    let [red, green, blue, alpha] = declared.diffuse_factor.0;
    let (specular, gloss) = (declared.specular_factor.0, declared.glossiness_factor.0);
    material.base_color_texture = textures.slot(object, declared.diffuse_texture.as_ref(), warnings);
    let packed = textures.slot(object, declared.specular_glossiness_texture.as_ref(), warnings);
    let Some(slot) = packed else {
        let ([r, g, b], metallic) = split([red, green, blue], specular);
        // The diffuse texture multiplies the base colour only where nothing of it is metal.
        material.base_color =
            if material.base_color_texture.is_some() { declared.diffuse_factor.0 } else { [r, g, b, alpha] };
        material.metallic = metallic;
        material.roughness = 1.0 - gloss;
        material.metallic_roughness_texture = None;
        return Ok(());
    };
    let image = Arc::clone(&textures.list[slot.texture].image);
    source.budget.spend(u64::from(image.width()) * u64::from(image.height()) * 4)?;
    let packed = RgbaImage::from_fn(image.width(), image.height(), |x, y| {
        let Rgba([r, g, b, a]) = *image.get_pixel(x, y);
        let texel = [r, g, b].map(linear);
        let specular = std::array::from_fn(|channel| texel[channel] * specular[channel]);
        let (_, metallic) = split([red, green, blue], specular);
        Rgba([0, byte(1.0 - gloss * f32::from(a) / 255.0), byte(metallic), 255])
    });
    let name = format!("{} as metallic-roughness", textures.list[slot.texture].name);
    let texture = Texture { name, image: Arc::new(packed), ..textures.list[slot.texture].clone() };
    material.base_color = declared.diffuse_factor.0;
    (material.metallic, material.roughness) = (1.0, 1.0);
    material.metallic_roughness_texture = Some(crate::scene::TextureRef { texture: textures.add(texture), ..slot });
    Ok(())
}

/// Base colour and metallic share that reflect the two colours.
fn split(diffuse: [f32; 3], specular: [f32; 3]) -> ([f32; 3], f32) {
    let strongest = specular.into_iter().fold(0.0, f32::max);
    let metallic = metallic(brightness(diffuse), brightness(specular), 1.0 - strongest);
    let from_diffuse = (1.0 - strongest) / (1.0 - DIELECTRIC) / (1.0 - metallic).max(SHORTEST);
    let color = std::array::from_fn(|channel| {
        let as_dielectric = diffuse[channel] * from_diffuse;
        let as_metal = (specular[channel] - DIELECTRIC * (1.0 - metallic)) / metallic.max(SHORTEST);
        let share = metallic * metallic;
        (as_dielectric * (1.0 - share) + as_metal * share).clamp(0.0, 1.0)
    });
    (color, metallic)
}

fn metallic(diffuse: f32, specular: f32, one_minus_strongest: f32) -> f32 {
    if specular < DIELECTRIC {
        return 0.0;
    }
    let a = DIELECTRIC;
    let b = diffuse * one_minus_strongest / (1.0 - DIELECTRIC) + specular - 2.0 * DIELECTRIC;
    let c = DIELECTRIC - specular;
    ((-b + (b * b - 4.0 * a * c).max(0.0).sqrt()) / (2.0 * a)).clamp(0.0, 1.0)
}

/// Perceived brightness of a linear colour.
fn brightness([r, g, b]: [f32; 3]) -> f32 {
    (0.299 * r * r + 0.587 * g * g + 0.114 * b * b).sqrt()
}

fn linear(byte: u8) -> f32 {
    linear_from_gamma(f64::from(byte) / 255.0) as f32
}

fn byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dielectrics_keep_their_colour_and_metals_take_their_reflection() {
        let (color, metallic) = split([0.5, 0.25, 0.125], [DIELECTRIC; 3]);
        assert_eq!(metallic, 0.0);
        for (channel, expected) in color.into_iter().zip([0.5, 0.25, 0.125]) {
            assert!((channel - expected).abs() < 1e-6, "{color:?}");
        }
        let (color, metallic) = split([0.0; 3], [0.9, 0.6, 0.3]);
        assert!((metallic - 1.0).abs() < 1e-3, "{metallic}");
        for (channel, expected) in color.into_iter().zip([0.9, 0.6, 0.3]) {
            assert!((channel - expected).abs() < 1e-3, "{color:?}");
        }
    }
}
