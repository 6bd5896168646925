//! Vertices and normals where a pose puts them, in f64 with the file's float weights: what exact
//! voxelization and mesh drawing read.

use glam::{DMat3, DMat4, DVec3};
use rayon::prelude::*;

use super::{Motion, Object, Pose, Primitive, Scene};

/// How one primitive gets from mesh space into the world.
enum Mover {
    Rigid(DMat4),
    Skinned(Vec<DMat4>),
}

impl Scene {
    /// World positions of a primitive's vertices, in vertex order.
    pub fn posed_positions(&self, object: &Object, primitive: usize, pose: &Pose) -> Vec<DVec3> {
        let primitive = &self.meshes[object.mesh].primitives[primitive];
        let positions = primitive.positions_at(pose.weights(object.mesh));
        let positions = positions.par_iter().enumerate();
        match self.mover(object, primitive, pose) {
            Mover::Rigid(matrix) => positions.map(|(_, p)| matrix.transform_point3(p.as_dvec3())).collect(),
            Mover::Skinned(joints) => {
                positions.map(|(vertex, p)| blend(primitive, vertex, &joints).transform_point3(p.as_dvec3())).collect()
            }
        }
    }

    /// World normals of a primitive's vertices, unit length; zero where the mesh has a zero normal.
    pub fn posed_normals(&self, object: &Object, primitive: usize, pose: &Pose) -> Vec<DVec3> {
        let primitive = &self.meshes[object.mesh].primitives[primitive];
        let normals = primitive.normals_at(pose.weights(object.mesh));
        let normals = normals.par_iter().enumerate();
        match self.mover(object, primitive, pose) {
            Mover::Rigid(matrix) => {
                let matrix = normal_matrix(&DMat3::from_mat4(matrix));
                normals.map(|(_, n)| (matrix * n.as_dvec3()).normalize_or_zero()).collect()
            }
            Mover::Skinned(joints) => {
                normals.map(|(vertex, n)| skinned_normal(primitive, vertex, n.as_dvec3(), &joints)).collect()
            }
        }
    }

    /// Of a primitive's vertices, in the world: the way their normal map's red grows, and the way its green
    /// does (glTF: normal × tangent · handedness), of any length. Empty where the mesh has no tangents.
    pub fn posed_tangents(&self, object: &Object, primitive: usize, pose: &Pose) -> Vec<[DVec3; 2]> {
        let primitive = &self.meshes[object.mesh].primitives[primitive];
        let weights = pose.weights(object.mesh);
        let (tangents, normals) = (primitive.tangents_at(weights), primitive.normals_at(weights));
        let axes = tangents.par_iter().zip(&*normals).map(|(tangent, normal)| {
            let along = tangent.truncate().as_dvec3();
            [along, normal.as_dvec3().cross(along) * f64::from(tangent.w)]
        });
        match self.mover(object, primitive, pose) {
            Mover::Rigid(matrix) => axes.map(|axes| axes.map(|axis| matrix.transform_vector3(axis))).collect(),
            Mover::Skinned(joints) => axes
                .enumerate()
                .map(|(vertex, axes)| {
                    let matrix = blend(primitive, vertex, &joints);
                    axes.map(|axis| matrix.transform_vector3(axis))
                })
                .collect(),
        }
    }

    /// Of a primitive's vertices: does its matrix turn what it moves inside out?
    pub fn mirrored_vertices(&self, object: &Object, primitive: usize, pose: &Pose) -> Vec<bool> {
        let primitive = &self.meshes[object.mesh].primitives[primitive];
        let vertices = 0..primitive.positions.len();
        match self.mover(object, primitive, pose) {
            Mover::Rigid(matrix) => vec![matrix.determinant() < 0.0; vertices.len()],
            Mover::Skinned(joints) => {
                vertices.into_par_iter().map(|vertex| blend(primitive, vertex, &joints).determinant() < 0.0).collect()
            }
        }
    }

    /// Of a primitive's vertices: what moves them.
    pub(super) fn blended_matrices(&self, object: &Object, primitive: usize, pose: &Pose) -> Vec<DMat4> {
        let primitive = &self.meshes[object.mesh].primitives[primitive];
        let vertices = 0..primitive.positions.len();
        match self.mover(object, primitive, pose) {
            Mover::Rigid(matrix) => vec![matrix; vertices.len()],
            Mover::Skinned(joints) => vertices.map(|vertex| blend(primitive, vertex, &joints)).collect(),
        }
    }

    fn mover(&self, object: &Object, primitive: &Primitive, pose: &Pose) -> Mover {
        match object.motion {
            Motion::Skinned { skin } if !primitive.joints.is_empty() => Mover::Skinned(self.joint_matrices(skin, pose)),
            _ => Mover::Rigid(pose.world_from_node[object.node]),
        }
    }
}

/// The weighted mean of a vertex's joint matrices. A joint without weight is not even read:
/// 0 · NaN would be NaN. f32 weights sum to 1 only nearly, which far away is millimetres.
fn blend(primitive: &Primitive, vertex: usize, joints: &[DMat4]) -> DMat4 {
    let influences = primitive.joints[vertex].into_iter().zip(primitive.weights[vertex]);
    let (mut sum, mut total) = (DMat4::ZERO, 0.0);
    for (joint, weight) in influences.filter(|&(_, weight)| weight > 0.0) {
        sum += joints[joint as usize] * f64::from(weight);
        total += f64::from(weight);
    }
    sum * (1.0 / total)
}

/// Opposed joints can cancel; then the strongest one alone turns the normal.
fn skinned_normal(primitive: &Primitive, vertex: usize, normal: DVec3, joints: &[DMat4]) -> DVec3 {
    let turned = |matrix: DMat4| (normal_matrix(&DMat3::from_mat4(matrix)) * normal).try_normalize();
    let strongest = || {
        let weights = primitive.weights[vertex];
        let slot = (1..weights.len()).fold(0, |best, slot| if weights[slot] > weights[best] { slot } else { best });
        turned(joints[primitive.joints[vertex][slot] as usize])
    };
    turned(blend(primitive, vertex, joints)).or_else(strongest).unwrap_or(normal.normalize_or_zero())
}

/// sign(det) · cofactor: |det| times the inverse transpose, without dividing. Mirrored objects
/// keep their outside outside.
pub fn normal_matrix(matrix: &DMat3) -> DMat3 {
    let [a, b, c] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let cofactor = DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b));
    if matrix.determinant() < 0.0 { cofactor * -1.0 } else { cofactor }
}
