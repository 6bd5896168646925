//! What a material shows at a point of a triangle: glTF's metallic-roughness, in linear light.

use glam::{DVec3, Vec2, Vec4};

use super::pyramid::{Texels, TexturePyramids};
use crate::scene::{AlphaMode, Material, Primitive, TextureRef};

/// A surface averaged over a piece of a triangle. Linear; all but emission in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub color: [f64; 3],
    /// How much of the piece is there: 1 unless the material blends; 0 where a mask cuts it out.
    pub opacity: f64,
    pub metallic: f64,
    pub roughness: f64,
    pub emission: [f64; 3],
}

/// Reads one primitive's material.
pub(super) struct SurfaceReader<'a> {
    pub primitive: &'a Primitive,
    pub material: &'a Material,
    pub textures: &'a TexturePyramids,
}

impl SurfaceReader<'_> {
    /// `place` weighs the corners; the piece is `share` of the triangle's area.
    pub fn read(&self, vertices: [u32; 3], place: DVec3, share: f64) -> Surface {
        let sample = |slot: Option<TextureRef>, texels| match slot {
            Some(slot) => self.sample(slot, texels, vertices, place, share),
            None => [1.0; 4],
        };
        let material = self.material;
        let texels = if material.alpha_mode == AlphaMode::Opaque { Texels::Opaque } else { Texels::Covering };
        let texture = sample(material.base_color_texture, texels);
        let vertex = self.vertex_color(vertices, place);
        let base: [f64; 4] =
            std::array::from_fn(|c| (f64::from(material.base_color[c]) * texture[c] * vertex[c]).clamp(0.0, 1.0));
        let opacity = match material.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => f64::from(u8::from(base[3] >= f64::from(cutoff))),
            AlphaMode::Blend => base[3],
        };
        let [_, rough, metal, _] = sample(material.metallic_roughness_texture, Texels::Linear);
        let glow = sample(material.emissive_texture, Texels::Opaque);
        Surface {
            color: [base[0], base[1], base[2]],
            opacity,
            metallic: (f64::from(material.metallic) * metal).clamp(0.0, 1.0),
            roughness: (f64::from(material.roughness) * rough).clamp(0.0, 1.0),
            emission: std::array::from_fn(|c| (f64::from(material.emissive[c]) * glow[c]).max(0.0)),
        }
    }

    fn sample(&self, slot: TextureRef, texels: Texels, vertices: [u32; 3], place: DVec3, share: f64) -> [f64; 4] {
        let coordinates = self.primitive.tex_coords.get(slot.tex_coord).map_or(&[][..], Vec::as_slice);
        let corner = |vertex: u32| {
            let tex_coord: Vec2 = coordinates.get(vertex as usize).copied().unwrap_or_default();
            slot.uv(tex_coord).as_dvec2()
        };
        let [a, b, c] = vertices.map(corner);
        let uv = a * place.x + b * place.y + c * place.z;
        let uv_area = 0.5 * (b - a).perp_dot(c - a).abs() * share;
        self.textures.sample(slot.texture, texels, uv, uv_area)
    }

    fn vertex_color(&self, vertices: [u32; 3], place: DVec3) -> [f64; 4] {
        let colors = &self.primitive.colors;
        if colors.is_empty() {
            return [1.0; 4];
        }
        let corner = |vertex: u32| colors.get(vertex as usize).map_or(Vec4::ONE, |&color| color).as_dvec4();
        let [a, b, c] = vertices.map(corner);
        (a * place.x + b * place.y + c * place.z).to_array()
    }
}
