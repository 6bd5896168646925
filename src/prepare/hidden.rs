//! Which objects a person hides: what is set by node, as frames know it, by object; and what tells one placing of
//! all objects from another.

use std::collections::BTreeSet;

use super::{Prepared, PreparedObject};
use crate::digest::Digest;
use crate::scene::{Motion, Object, Pose};
use crate::settings::{Discretization, Discretizer, Hidden, Stretching, Visibility, VisibilityError};

/// Which objects are voxelized every frame, and which are moved: the others are left out, as are hidden ones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftToEach {
    pub not_voxelized: Hidden,
    pub not_moved: Hidden,
}

impl PreparedObject {
    /// Every frame, from its posed triangles; else its voxels are moved.
    pub fn is_voxelized(&self, discretization: &Discretization) -> bool {
        match (discretization.discretizer, discretization.stretching) {
            (Discretizer::Voxelize, _) => true,
            (Discretizer::Transform, Stretching::Move) => false,
            (Discretizer::Transform, Stretching::Voxelize) => self.unmovable.is_some(),
        }
    }
}

impl Prepared {
    /// What of this scene is hidden in a pose: by a person, by the file, or by a scale that leaves nothing.
    pub fn hidden(&self, visibility: &Visibility, pose: &Pose) -> Result<Hidden, VisibilityError> {
        let shown = visibility.shown_nodes(&self.scene)?;
        let is_hidden = |object: &Object| !shown[object.node] || !self.scene.is_seen(object, pose);
        Ok(self.objects.iter().map(|object| is_hidden(&object.object)).collect())
    }

    /// The same by node, for what nodes carry beside objects.
    pub fn shown_nodes(&self, visibility: &Visibility, pose: &Pose) -> Result<Vec<bool>, VisibilityError> {
        let mut shown = visibility.shown_nodes(&self.scene)?;
        shown.iter_mut().enumerate().for_each(|(node, shown)| *shown &= pose.shows(node));
        Ok(shown)
    }

    /// Stands for where every triangle that is shown is, which are hidden, and the grid around them: by bits, so that a
    /// matrix that is not finite is equal to itself.
    pub fn placed(&self, pose: &Pose, hidden: &Hidden) -> Digest {
        let nodes = self.moving_nodes_of(hidden);
        let matrices: Vec<[f64; 16]> = nodes.iter().map(|&node| pose.world_from_node[node].to_cols_array()).collect();
        let shown = (0..).zip(&self.objects).filter(|(index, _)| !hidden.contains(*index));
        let weights = shown.flat_map(|(_, object)| pose.weights(object.object.mesh).unwrap_or_default());
        let weights: Vec<f64> = weights.copied().collect();
        let hidden: Vec<u8> = (0..self.objects.len()).map(|object| u8::from(hidden.contains(object))).collect();
        let grid = [self.grid.corner().to_array(), [self.grid.span, f64::from(self.grid.depth), 0.0]];
        let (matrices, weights) = (bytemuck::cast_slice(&matrices), bytemuck::cast_slice(&weights));
        Digest::of_bytes(&[matrices, weights, &hidden, bytemuck::cast_slice(&grid)])
    }

    /// Nodes whose matrices place something that is shown, ascending: those of objects, and joints.
    fn moving_nodes_of(&self, hidden: &Hidden) -> BTreeSet<usize> {
        let shown = (0..).zip(&self.objects).filter(|(index, _)| !hidden.contains(*index));
        let (mut nodes, mut skins) = (BTreeSet::new(), BTreeSet::new());
        for (_, PreparedObject { object, .. }) in shown {
            nodes.insert(object.node);
            if let Motion::Skinned { skin } = object.motion
                && skins.insert(skin)
            {
                nodes.extend(self.scene.skins[skin].joints.iter().copied());
            }
        }
        nodes
    }

    /// What the voxelizer of posed triangles leaves out, and what moving does, each beside what is hidden.
    pub fn left_to_each(&self, discretization: &Discretization, hidden: &Hidden) -> LeftToEach {
        let is_voxelized = |object: usize| self.objects[object].is_voxelized(discretization);
        let objects = self.objects.len();
        LeftToEach {
            not_voxelized: hidden.and(objects, |object| !is_voxelized(object)),
            not_moved: hidden.and(objects, is_voxelized),
        }
    }
}
