//! The posed triangles on the GPU: uploaded once, moved by the vertex shader, drawn by whoever looks at
//! them: the mesh view, the surface image, and lights for their shadow maps.

mod params;
pub mod posed;
pub mod scene;
mod texture;
mod triangles;
mod vertex;

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Constant, Mirror, constants, mirror};

pub use params::alpha_of;
pub use posed::PosedMesh;
pub use scene::{MeshScene, Textures};
pub use texture::RecordLevels;

pub const ALPHA_OPAQUE: u32 = 0;
pub const ALPHA_MASK: u32 = 1;
pub const ALPHA_BLEND: u32 = 2;
/// Set in a packed tangent whose bitangent is −(normal × tangent).
pub const LEFT_HANDED: u32 = 1 << 30;

pub const CONSTANTS: &[Constant] = constants![
    integer ALPHA_BLEND,
    integer ALPHA_MASK,
    integer LEFT_HANDED,
];

/// Mirror of `MeshVertex` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct MeshVertex {
    pub position: [f32; 3],
    pub color: u32,
    pub normal: [f32; 3],
    pub tangent: u32,
    pub tex_coords: [f32; 4],
}

/// Mirror of `VertexJoints` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct VertexJoints {
    pub joints: [u32; 2],
    pub weights: [f32; 4],
}

/// Mirror of `TextureSlot` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct TextureSlot {
    pub u: [f32; 3],
    pub tex_coord: u32,
    pub v: [f32; 3],
    pub is_filled: u32,
}

/// Mirror of `DrawParams` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DrawParams {
    pub base_color: [f32; 4],
    pub first_index: u32,
    pub first_vertex: u32,
    pub first_matrix: u32,
    pub object: u32,
    pub alpha_mode: u32,
    pub cutoff: f32,
    pub unlit: u32,
    pub has_tangents: u32,
    pub emissive: [f32; 3],
    pub normal_scale: f32,
    pub roughness: f32,
    pub metallic: f32,
    pub single_sided: u32,
    pub pad: u32,
    pub base_color_slot: TextureSlot,
    pub metallic_roughness_slot: TextureSlot,
    pub normal_slot: TextureSlot,
    pub emissive_slot: TextureSlot,
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(MeshVertex, "shared/posed_mesh.wgsl", "MeshVertex", position, color, normal, tangent, tex_coords),
    mirror!(TextureSlot, "shared/posed_mesh.wgsl", "TextureSlot", u, tex_coord, v, is_filled),
    mirror!(VertexJoints, "shared/posed_mesh.wgsl", "VertexJoints", joints, weights),
    mirror!(
        DrawParams,
        "shared/posed_mesh.wgsl",
        "DrawParams",
        base_color,
        first_index,
        first_vertex,
        first_matrix,
        object,
        alpha_mode,
        cutoff,
        unlit,
        has_tangents,
        emissive,
        normal_scale,
        roughness,
        metallic,
        single_sided,
        pad,
        base_color_slot,
        metallic_roughness_slot,
        normal_slot,
        emissive_slot
    ),
];
