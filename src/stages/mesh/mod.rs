//! The posed triangles on the GPU: uploaded once, moved by the vertex shader, drawn by whoever looks at
//! them: the mesh view, and lights for their shadow maps.

pub mod posed;
pub mod scene;
mod texture;

use bytemuck::{Pod, Zeroable};

pub use posed::PosedMesh;
pub use scene::MeshScene;

pub const ALPHA_OPAQUE: u32 = 0;
pub const ALPHA_MASK: u32 = 1;
pub const ALPHA_BLEND: u32 = 2;

/// Mirror of `MeshVertex` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct MeshVertex {
    pub position: [f32; 3],
    pub normal: u32,
    pub tex_coord: [f32; 2],
    pub color: u32,
    pub pad: u32,
}

/// Mirror of `VertexJoints` in shaders/shared/posed_mesh.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct VertexJoints {
    pub joints: [u32; 2],
    pub weights: [f32; 4],
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
    pub pad: u32,
}
