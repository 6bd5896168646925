//! What a draw says about its material, in the order of the uniform.

use super::scene::{MeshScene, Place};
use super::{ALPHA_BLEND, ALPHA_MASK, ALPHA_OPAQUE, DrawParams, TextureSlot};
use crate::data::texels::Texels;
use crate::scene::{AlphaMode, Material, Primitive, TextureRef};

pub(super) fn draw_params(
    mesh: &MeshScene,
    (primitive, place): (&Primitive, &Place),
    material: &Material,
    (object, first_matrix): (u32, u32),
) -> DrawParams {
    let (alpha_mode, cutoff) = alpha_of(material);
    let slot = |slot, texels| TextureSlot::new(slot, mesh.texture(slot, texels).is_some());
    DrawParams {
        base_color: material.base_color,
        first_index: place.first_index,
        first_vertex: place.first_vertex,
        first_matrix,
        object,
        alpha_mode,
        cutoff,
        unlit: u32::from(material.unlit),
        has_tangents: u32::from(!primitive.tangents.is_empty()),
        emissive: material.emissive,
        normal_scale: material.normal_scale,
        roughness: material.roughness,
        metallic: material.metallic,
        single_sided: u32::from(!material.double_sided),
        pad: 0,
        base_color_slot: slot(material.base_color_texture, Texels::of_base_color(material)),
        metallic_roughness_slot: slot(material.metallic_roughness_texture, Texels::Linear),
        normal_slot: slot(material.normal_texture, Texels::Linear),
        emissive_slot: slot(material.emissive_texture, Texels::Opaque),
    }
}

/// `ALPHA_*`, and what a mask cuts off.
pub fn alpha_of(material: &Material) -> (u32, f32) {
    match material.alpha_mode {
        AlphaMode::Opaque => (ALPHA_OPAQUE, 0.0),
        AlphaMode::Mask { cutoff } => (ALPHA_MASK, cutoff),
        AlphaMode::Blend => (ALPHA_BLEND, 0.0),
    }
}

impl TextureSlot {
    /// `is_filled`: there is a texture to read.
    pub fn new(slot: Option<TextureRef>, is_filled: bool) -> Self {
        let slot = slot.unwrap_or(TextureRef::new(0, 0));
        let (matrix, shift) = (slot.uv_from_tex_coord.matrix2, slot.uv_from_tex_coord.translation);
        Self {
            u: [matrix.x_axis.x, matrix.y_axis.x, shift.x],
            tex_coord: slot.tex_coord as u32,
            v: [matrix.x_axis.y, matrix.y_axis.y, shift.y],
            is_filled: u32::from(is_filled),
        }
    }
}
