//! What a material shows at a point of a triangle: glTF's metallic-roughness, in linear light.

use glam::{DVec2, DVec3, Vec2, Vec4};

use super::pyramid::TexturePyramids;
use crate::data::texels::Texels;
use crate::scene::{AlphaMode, Material, Primitive, TextureRef};

/// A surface averaged over a piece of a triangle. Linear; all but emission in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub color: [f64; 3],
    /// How much of the piece is there: 1 unless the material blends, or a mask cuts.
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
        let vertex = self.vertex_color(vertices, place);
        let factor: [f64; 4] = std::array::from_fn(|c| f64::from(material.base_color[c]) * vertex[c]);
        let texels = Texels::of_base_color(material);
        let texture = match (material.alpha_mode, texels) {
            (AlphaMode::Mask { cutoff }, Texels::Cut { least }) => {
                let is_there = |alpha: f64| (factor[3] * alpha) as f32 >= cutoff;
                let rgba = material.base_color_texture.map_or([1.0; 4], |slot| {
                    let footprint = self.footprint(slot, vertices, place, share);
                    self.textures.sample_cut(slot.texture, least, footprint, is_there)
                });
                // Shares are those without colours of vertices; what these cut out altogether is not there.
                [rgba[0], rgba[1], rgba[2], if is_there(1.0) { rgba[3] } else { 0.0 }]
            }
            _ => sample(material.base_color_texture, texels),
        };
        let base: [f64; 3] = std::array::from_fn(|c| (factor[c] * texture[c]).clamp(0.0, 1.0));
        let opacity = match material.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { .. } => texture[3],
            AlphaMode::Blend => (factor[3] * texture[3]).clamp(0.0, 1.0),
        };
        let [_, rough, metal, _] = sample(material.metallic_roughness_texture, Texels::Linear);
        let glow = sample(material.emissive_texture, Texels::Opaque);
        Surface {
            color: base,
            opacity,
            metallic: (f64::from(material.metallic) * metal).clamp(0.0, 1.0),
            roughness: (f64::from(material.roughness) * rough).clamp(0.0, 1.0),
            emission: std::array::from_fn(|c| (f64::from(material.emissive[c]) * glow[c]).max(0.0)),
        }
    }

    fn sample(&self, slot: TextureRef, texels: Texels, vertices: [u32; 3], place: DVec3, share: f64) -> [f64; 4] {
        let (uv, uv_area) = self.footprint(slot, vertices, place, share);
        self.textures.sample(slot.texture, texels, uv, uv_area)
    }

    /// Texture coordinates of the piece, and what it covers of the unit square.
    fn footprint(&self, slot: TextureRef, vertices: [u32; 3], place: DVec3, share: f64) -> (DVec2, f64) {
        let coordinates = self.primitive.tex_coords.get(slot.tex_coord).map_or(&[][..], Vec::as_slice);
        let corner = |vertex: u32| {
            let tex_coord: Vec2 = coordinates.get(vertex as usize).copied().unwrap_or_default();
            slot.uv(tex_coord).as_dvec2()
        };
        let [a, b, c] = vertices.map(corner);
        let uv = a * place.x + b * place.y + c * place.z;
        (uv, 0.5 * (b - a).perp_dot(c - a).abs() * share)
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
