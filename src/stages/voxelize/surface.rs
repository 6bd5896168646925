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
    primitive: &'a Primitive,
    material: &'a Material,
    textures: &'a TexturePyramids,
    /// How its base colour texture is read.
    base_color: Texels,
}

/// A part of a triangle: where its middle is, by a weight a corner, and its share of the triangle's area.
#[derive(Clone, Copy)]
struct Piece {
    vertices: [u32; 3],
    place: DVec3,
    share: f64,
}

impl<'a> SurfaceReader<'a> {
    pub fn new(primitive: &'a Primitive, material: &'a Material, textures: &'a TexturePyramids) -> Self {
        Self { primitive, material, textures, base_color: Texels::of_base_color(material) }
    }

    /// `place` weighs the corners; the piece is `share` of the triangle's area.
    pub fn read(&self, vertices: [u32; 3], place: DVec3, share: f64) -> Surface {
        let piece = Piece { vertices, place, share };
        let material = self.material;
        let [red, green, blue, opacity] = self.base_color(piece);
        let [_, rough, metal, _] = self.sample(material.metallic_roughness_texture, Texels::Linear, piece);
        let glow = self.sample(material.emissive_texture, Texels::Opaque, piece);
        Surface {
            color: [red, green, blue],
            opacity,
            metallic: (f64::from(material.metallic) * metal).clamp(0.0, 1.0),
            roughness: (f64::from(material.roughness) * rough).clamp(0.0, 1.0),
            emission: std::array::from_fn(|c| (f64::from(material.emissive[c]) * glow[c]).max(0.0)),
        }
    }

    /// Colour, and which share of the piece is there.
    fn base_color(&self, piece: Piece) -> [f64; 4] {
        let (slot, vertex) = (self.material.base_color_texture, self.vertex_color(piece));
        let factor: [f64; 4] = std::array::from_fn(|c| f64::from(self.material.base_color[c]) * vertex[c]);
        let (texture, opacity) = match (self.material.alpha_mode, self.base_color) {
            (AlphaMode::Mask { cutoff }, Texels::Cut { least }) => {
                let is_there = |alpha: f64| (factor[3] * alpha) as f32 >= cutoff;
                let texture = slot.map_or([1.0; 4], |slot| {
                    self.textures.sample_cut(slot.texture, least, self.footprint(slot, piece), is_there)
                });
                // Shares are those without colours of vertices; what these cut out altogether is not there.
                (texture, if is_there(1.0) { texture[3] } else { 0.0 })
            }
            (AlphaMode::Blend, texels) => {
                let texture = self.sample(slot, texels, piece);
                (texture, factor[3] * texture[3])
            }
            (_, texels) => (self.sample(slot, texels, piece), 1.0),
        };
        [factor[0] * texture[0], factor[1] * texture[1], factor[2] * texture[2], opacity]
            .map(|value| value.clamp(0.0, 1.0))
    }

    /// White where the slot is empty.
    fn sample(&self, slot: Option<TextureRef>, texels: Texels, piece: Piece) -> [f64; 4] {
        slot.map_or([1.0; 4], |slot| {
            let (uv, uv_area) = self.footprint(slot, piece);
            self.textures.sample(slot.texture, texels, uv, uv_area)
        })
    }

    /// Texture coordinates of the piece, and what it covers of the unit square.
    fn footprint(&self, slot: TextureRef, Piece { vertices, place, share }: Piece) -> (DVec2, f64) {
        let coordinates = self.primitive.tex_coords.get(slot.tex_coord).map_or(&[][..], Vec::as_slice);
        let corner = |vertex: u32| {
            let tex_coord: Vec2 = coordinates.get(vertex as usize).copied().unwrap_or_default();
            slot.uv(tex_coord).as_dvec2()
        };
        let [a, b, c] = vertices.map(corner);
        let uv = a * place.x + b * place.y + c * place.z;
        (uv, 0.5 * (b - a).perp_dot(c - a).abs() * share)
    }

    fn vertex_color(&self, Piece { vertices, place, .. }: Piece) -> [f64; 4] {
        let colors = &self.primitive.colors;
        if colors.is_empty() {
            return [1.0; 4];
        }
        let corner = |vertex: u32| colors.get(vertex as usize).map_or(Vec4::ONE, |&color| color).as_dvec4();
        let [a, b, c] = vertices.map(corner);
        (a * place.x + b * place.y + c * place.z).to_array()
    }
}
