//! The exact voxels that others are compared with.

use std::sync::Arc;

use super::ExperimentError;
use super::board::Share;
use super::lab::Lab;
use crate::settings::Settings;

impl Lab {
    /// Voxelizes the posed mesh exactly.
    pub async fn take_exact(&mut self, settings: &Settings, share: Share) -> Result<(), ExperimentError> {
        let (prepared, motion) = (Arc::clone(&self.prepared), settings.shot.motion.clone());
        let hidden = prepared.hidden(&settings.shot.visibility, &prepared.pose(&settings.shot.motion)?)?;
        let exact =
            self.work((share, "voxelizing the posed mesh"), move |progress| prepared.exact(&motion, &hidden, progress));
        let exact = exact.await??;
        self.warn(&exact.warnings);
        self.engine.offer_exact(Arc::new(exact));
        Ok(())
    }
}
