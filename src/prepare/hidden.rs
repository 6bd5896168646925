//! Which objects a person hides: what is set by node, as frames know it, by object.

use super::Prepared;
use crate::settings::{Hidden, Visibility, VisibilityError};

impl Prepared {
    /// What of this scene is hidden.
    pub fn hidden(&self, visibility: &Visibility) -> Result<Hidden, VisibilityError> {
        let shown = visibility.shown_nodes(&self.scene)?;
        Ok(self.objects.iter().map(|object| !shown[object.object.node]).collect())
    }
}
