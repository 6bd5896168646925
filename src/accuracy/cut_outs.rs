//! Where a surface is a hole: MASK by its cutoff, BLEND where it is less than half there.
//!
//! In: a primitive's texture coordinates, colours and material, and a place on one of its triangles.
//! Alpha is factor times vertex colour times the finest level of the base colour texture.

use glam::{DVec2, DVec3};

use crate::data::texels::Texels;
use crate::prepare::Prepared;
use crate::scene::{AlphaMode, Material, Primitive};
use crate::stages::voxelize::TexturePyramids;

/// A blended surface that is less there than this is a hole to rays.
const BLEND_CUTOFF: f64 = 0.5;

/// A primitive whose material is not opaque.
pub struct CutOuts<'a> {
    primitive: &'a Primitive,
    material: &'a Material,
    textures: &'a TexturePyramids,
    cutoff: f64,
}

impl<'a> CutOuts<'a> {
    /// `None` where the material is opaque.
    pub fn new(prepared: &'a Prepared, primitive: &'a Primitive) -> Option<Self> {
        let material = prepared.scene.materials.get(primitive.material?)?;
        let cutoff = match material.alpha_mode {
            AlphaMode::Opaque => return None,
            AlphaMode::Mask { cutoff } => f64::from(cutoff),
            AlphaMode::Blend => BLEND_CUTOFF,
        };
        Some(Self { primitive, material, textures: &prepared.textures, cutoff })
    }

    /// `place`: a weight a corner, together 1.
    pub fn is_hole(&self, vertices: [u32; 3], place: DVec3) -> bool {
        let weights = place.to_array();
        let mean = |value: &dyn Fn(usize) -> f64| -> f64 {
            vertices.iter().zip(weights).map(|(&vertex, weight)| weight * value(vertex as usize)).sum()
        };
        let vertex_alpha = mean(&|vertex| self.primitive.colors.get(vertex).map_or(1.0, |color| f64::from(color.w)));
        let texture_alpha = self.material.base_color_texture.map_or(1.0, |slot| {
            let coordinates = self.primitive.tex_coords.get(slot.tex_coord).map_or(&[][..], Vec::as_slice);
            let uv = |vertex: usize| slot.uv(coordinates.get(vertex).copied().unwrap_or_default());
            let uv = DVec2::new(mean(&|vertex| f64::from(uv(vertex).x)), mean(&|vertex| f64::from(uv(vertex).y)));
            self.textures.sample(slot.texture, Texels::Covering, uv, 0.0)[3]
        });
        f64::from(self.material.base_color[3]) * vertex_alpha * texture_alpha < self.cutoff
    }
}
