//! glTF's metallic-roughness materials and the images they read.

use glam::{Affine2, Vec2};
use image::RgbaImage;

#[derive(Clone, Debug)]
pub struct Material {
    pub name: String,
    /// Linear RGBA.
    pub base_color: [f32; 4],
    pub base_color_texture: Option<TextureRef>,
    pub metallic: f32,
    pub roughness: f32,
    /// G = roughness, B = metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
    pub normal_texture: Option<TextureRef>,
    pub normal_scale: f32,
    /// Linear RGB, `KHR_materials_emissive_strength` multiplied in; may exceed 1.
    pub emissive: [f32; 3],
    pub emissive_texture: Option<TextureRef>,
    pub alpha_mode: AlphaMode,
    pub double_sided: bool,
    /// KHR_materials_unlit: shows its base colour whatever the light.
    pub unlit: bool,
}

impl Default for Material {
    /// glTF's default material, used where a primitive names none.
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            emissive: [0.0; 3],
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    Opaque,
    Mask { cutoff: f32 },
    Blend,
}

/// A texture as one material slot reads it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Index into [`super::Scene::textures`].
    pub texture: usize,
    /// 0 or 1: which `TEXCOORD_n`.
    pub tex_coord: usize,
    /// KHR_texture_transform.
    pub uv_from_tex_coord: Affine2,
}

impl TextureRef {
    /// Reads the texture where the coordinates say, untransformed.
    pub const fn new(texture: usize, tex_coord: usize) -> Self {
        Self { texture, tex_coord, uv_from_tex_coord: Affine2::IDENTITY }
    }

    /// Where the texture is read for a vertex of this texture coordinate.
    pub fn uv(&self, tex_coord: Vec2) -> Vec2 {
        self.uv_from_tex_coord.transform_point2(tex_coord)
    }
}

/// An image and how it is addressed. Texels are stored as in the file (8-bit, sRGB for colours).
#[derive(Clone, Debug)]
pub struct Texture {
    pub name: String,
    pub image: std::sync::Arc<RgbaImage>,
    pub wrap: [Wrap; 2],
    /// True: take the nearest texel; false: filter linearly.
    pub nearest: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    Repeat,
    MirroredRepeat,
    ClampToEdge,
}
