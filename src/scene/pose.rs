//! Where every node is at one moment.

use std::collections::BTreeMap;

use glam::{DMat3, DMat4};

use super::{LocalTransform, Property, Scene};

/// World matrices of all nodes, in node order, and which are visible. A pure function of (scene, clip, time):
/// scrubbing to t and playing to t give the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    pub world_from_node: Vec<DMat4>,
    /// With all that is above it.
    pub is_visible: Vec<bool>,
    /// By mesh, of those whose weights a clip moves.
    pub morph_weights: BTreeMap<usize, Vec<f64>>,
}

impl Pose {
    /// Of a mesh's morph targets; `None` where they do not move.
    pub fn weights(&self, mesh: usize) -> Option<&[f64]> {
        self.morph_weights.get(&mesh).map(Vec::as_slice)
    }

    /// Whether what a node carries is there: it is visible, and its matrix takes no area to nothing. One that is not
    /// finite is somewhere, if not at a place that can be shown.
    pub fn shows(&self, node: usize) -> bool {
        self.is_visible[node] && leaves_area(&DMat3::from_mat4(self.world_from_node[node]))
    }
}

/// Whether a triangle may have an area behind the matrix: its scale is zero along one axis at most.
fn leaves_area(linear: &DMat3) -> bool {
    let [a, b, c] = [linear.x_axis, linear.y_axis, linear.z_axis];
    // Relative to its size, so that a matrix of rank 1 has none whatever its rounding.
    let size = a.length_squared() + b.length_squared() + c.length_squared();
    let area = a.cross(b).length_squared() + b.cross(c).length_squared() + c.cross(a).length_squared();
    let is_none = area <= LEAST_AREA_SHARE * size * size;
    // False for what is not finite.
    !is_none
}

/// Of the squared size of a matrix: what rounding leaves of an area that is none.
const LEAST_AREA_SHARE: f64 = 1e-24;

impl Scene {
    /// The pose of a clip at a time; the rest pose without one, or where the scene has no such clip.
    /// Before its first and after its last key a channel keeps that key's value.
    pub fn pose(&self, clip: Option<usize>, time_secs: f64) -> Pose {
        let mut locals: Vec<LocalTransform> = self.nodes.iter().map(|node| node.local).collect();
        let mut is_visible: Vec<bool> = self.nodes.iter().map(|node| node.is_visible).collect();
        let mut morph_weights = BTreeMap::new();
        for channel in clip.and_then(|clip| self.clips.get(clip)).iter().flat_map(|clip| &clip.channels) {
            if let Property::MorphWeights { mesh, .. } = channel.property {
                morph_weights.insert(mesh, channel.sample_weights(time_secs));
                continue;
            }
            if channel.property == Property::Visibility {
                if let Some(visible) = is_visible.get_mut(channel.node) {
                    *visible = channel.sample_number(time_secs) != 0.0;
                }
                continue;
            }
            // Only translation, rotation and scale can be animated: a matrix stays as it is.
            if let Some(LocalTransform::Trs(trs)) = locals.get_mut(channel.node) {
                match channel.property {
                    Property::Translation => trs.translation = channel.sample_vector(time_secs),
                    Property::Rotation => trs.rotation = channel.sample_rotation(time_secs),
                    Property::Scale => trs.scale = channel.sample_vector(time_secs),
                    Property::Visibility | Property::MorphWeights { .. } => {}
                }
            }
        }
        let mut world_from_node: Vec<DMat4> = Vec::with_capacity(self.nodes.len());
        for (index, (node, local)) in self.nodes.iter().zip(&locals).enumerate() {
            let local = local.matrix();
            world_from_node.push(node.parent.map_or(local, |parent| world_from_node[parent] * local));
            is_visible[index] &= node.parent.is_none_or(|parent| is_visible[parent]);
        }
        Pose { world_from_node, is_visible, morph_weights }
    }

    /// `world_from_joint · joint_from_mesh` for each joint of a skin: straight from the mesh as it
    /// was bound into the world. The transform of the node that carries the mesh plays no part.
    pub fn joint_matrices(&self, skin: usize, pose: &Pose) -> Vec<DMat4> {
        let skin = self.skins.get(skin);
        let joints = skin.iter().flat_map(|skin| skin.joints.iter().zip(&skin.inverse_bind));
        joints.map(|(&joint, inverse_bind)| pose.world_from_node[joint] * *inverse_bind).collect()
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_scale_of_zero_along_two_axes_takes_everything_and_along_one_flattens() {
        let turned = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
        let scaled = |scale: DVec3| turned * DMat3::from_diagonal(scale) * turned;
        for scale in [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.0, 1e9)] {
            assert!(!leaves_area(&scaled(scale)), "{scale}");
        }
        for scale in [DVec3::ONE, DVec3::new(1.0, 0.0, 1.0), DVec3::splat(1e-9), DVec3::new(1e-6, 1.0, 1e-6)] {
            assert!(leaves_area(&scaled(scale)), "{scale}");
        }
        assert!(leaves_area(&DMat3::from_diagonal(DVec3::new(f64::NAN, 1.0, 1.0))));
    }
}
