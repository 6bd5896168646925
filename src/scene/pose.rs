//! Where every node is at one moment.

use glam::DMat4;

use super::{LocalTransform, Property, Scene};

/// World matrices of all nodes, in node order. A pure function of (scene, clip, time):
/// scrubbing to t and playing to t give the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    pub world_from_node: Vec<DMat4>,
}

impl Scene {
    /// The pose of a clip at a time; the rest pose without one, or where the scene has no such clip.
    /// Before its first and after its last key a channel keeps that key's value.
    pub fn pose(&self, clip: Option<usize>, time_secs: f64) -> Pose {
        let mut locals: Vec<LocalTransform> = self.nodes.iter().map(|node| node.local).collect();
        for channel in clip.and_then(|clip| self.clips.get(clip)).iter().flat_map(|clip| &clip.channels) {
            // Only translation, rotation and scale can be animated: a matrix stays as it is.
            if let Some(LocalTransform::Trs(trs)) = locals.get_mut(channel.node) {
                match channel.property {
                    Property::Translation => trs.translation = channel.sample_vector(time_secs),
                    Property::Rotation => trs.rotation = channel.sample_rotation(time_secs),
                    Property::Scale => trs.scale = channel.sample_vector(time_secs),
                }
            }
        }
        let mut world_from_node: Vec<DMat4> = Vec::with_capacity(self.nodes.len());
        for (node, local) in self.nodes.iter().zip(&locals) {
            let local = local.matrix();
            world_from_node.push(node.parent.map_or(local, |parent| world_from_node[parent] * local));
        }
        Pose { world_from_node }
    }

    /// `world_from_joint · joint_from_mesh` for each joint of a skin: straight from the mesh as it
    /// was bound into the world. The transform of the node that carries the mesh plays no part.
    pub fn joint_matrices(&self, skin: usize, pose: &Pose) -> Vec<DMat4> {
        let skin = self.skins.get(skin);
        let joints = skin.iter().flat_map(|skin| skin.joints.iter().zip(&skin.inverse_bind));
        joints.map(|(&joint, inverse_bind)| pose.world_from_node[joint] * *inverse_bind).collect()
    }
}
