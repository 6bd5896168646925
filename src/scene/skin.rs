//! A skeleton as a mesh is bound to it.

use glam::DMat4;

#[derive(Clone, Debug)]
pub struct Skin {
    pub name: String,
    /// Node indices; a vertex's joint number points in here.
    pub joints: Vec<usize>,
    /// `joint_from_mesh` at bind time, as many as `joints`.
    pub inverse_bind: Vec<DMat4>,
}
