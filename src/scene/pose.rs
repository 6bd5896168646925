//! Where every node is at one moment.

use glam::DMat4;

/// World matrices of all nodes, in node order. A pure function of (scene, clip, time):
/// scrubbing to t and playing to t give the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    pub world_from_node: Vec<DMat4>,
}
