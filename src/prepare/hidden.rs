//! Which objects a person hides: what is set by node, as frames know it, by object; and what tells one placing of
//! all objects from another.

use super::Prepared;
use crate::digest::Digest;
use crate::scene::{Object, Pose};
use crate::settings::{Hidden, Visibility, VisibilityError};

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

    /// Stands for where every triangle is, which are hidden, and the grid around them: by bits, so that a matrix that
    /// is not finite is equal to itself.
    pub fn placed(&self, pose: &Pose, hidden: &Hidden) -> Digest {
        let matrices: Vec<[f64; 16]> = pose.world_from_node.iter().map(glam::DMat4::to_cols_array).collect();
        let hidden: Vec<u8> = (0..self.objects.len()).map(|object| u8::from(hidden.contains(object))).collect();
        let grid = [self.grid.corner().to_array(), [self.grid.span, f64::from(self.grid.depth), 0.0]];
        Digest::of_bytes(&[bytemuck::cast_slice(&matrices), &hidden, bytemuck::cast_slice(&grid)])
    }
}
