//! One vertex as the shaders read it.

use glam::{Vec2, Vec3, Vec4};

use super::{LEFT_HANDED, MeshVertex, VertexJoints};
use crate::data::albedo::pack_color;
use crate::data::packing::pack_normal;
use crate::scene::Primitive;

/// All vertices at the weights of morph targets that a pose has. Zero stands in for what the primitive does not have,
/// white for its colour.
pub(super) fn mesh_vertices(primitive: &Primitive, weights: Option<&[f64]>) -> Vec<MeshVertex> {
    let positions = primitive.positions_at(weights);
    let (normals, tangents) = (primitive.normals_at(weights), primitive.tangents_at(weights));
    let placed = |vertex: usize| Placed {
        position: positions[vertex],
        normal: normals.get(vertex).copied().unwrap_or(Vec3::ZERO),
        tangent: tangents.get(vertex).copied(),
    };
    (0..positions.len()).map(|vertex| mesh_vertex(primitive, vertex, placed(vertex))).collect()
}

/// What morph targets displace of a vertex.
struct Placed {
    position: Vec3,
    normal: Vec3,
    tangent: Option<Vec4>,
}

fn mesh_vertex(primitive: &Primitive, vertex: usize, placed: Placed) -> MeshVertex {
    let [first, second] = [0, 1].map(|set| primitive.tex_coords[set].get(vertex).copied().unwrap_or(Vec2::ZERO));
    let color = primitive.colors.get(vertex).copied().unwrap_or(Vec4::ONE);
    MeshVertex {
        position: placed.position.to_array(),
        color: pack_color(color.to_array().map(f64::from)),
        normal: placed.normal.to_array(),
        tangent: placed.tangent.map_or(0, pack_tangent),
        tex_coords: [first.x, first.y, second.x, second.y],
    }
}

fn pack_tangent(tangent: Vec4) -> u32 {
    pack_normal(tangent.truncate().as_dvec3()) | if tangent.w < 0.0 { LEFT_HANDED } else { 0 }
}

/// All zero for a primitive that has no joints.
pub(super) fn vertex_joints(primitive: &Primitive, vertex: usize) -> VertexJoints {
    let joints = primitive.joints.get(vertex).copied().unwrap_or_default().map(u32::from);
    VertexJoints {
        joints: [joints[0] | joints[1] << 16, joints[2] | joints[3] << 16],
        weights: primitive.weights.get(vertex).copied().unwrap_or_default(),
    }
}
