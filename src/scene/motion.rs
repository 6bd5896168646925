//! What moves, and how: the objects of a scene and the stretch each bakes into its voxels
//! (right-polar decomposition W = R·U).

use glam::DMat3;

/// One drawable: a node with a mesh. The unit of Object I-O (section 4.2).
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    pub node: usize,
    pub mesh: usize,
    pub motion: Motion,
    /// U, baked into the mesh before voxelization: what is left to move is rigid.
    /// The node's for rigid objects; one for all parts of a skin, the mean over joints and clips.
    pub stretch: DMat3,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No clip moves the node or its ancestors.
    Static,
    /// The node's world matrix moves it.
    Rigid,
    /// The joints of this skin move it.
    Skinned { skin: usize },
}
