//! Which objects a person hides: what is set by node, as frames know it, by object; and what tells one placing of
//! all objects from another.

use super::Prepared;
use crate::digest::Digest;
use crate::scene::Pose;
use crate::settings::{Hidden, Visibility, VisibilityError};

impl Prepared {
    /// What of this scene is hidden.
    pub fn hidden(&self, visibility: &Visibility) -> Result<Hidden, VisibilityError> {
        let shown = visibility.shown_nodes(&self.scene)?;
        Ok(self.objects.iter().map(|object| !shown[object.object.node]).collect())
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
