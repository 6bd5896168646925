//! Lights of a prepared scene: which of them a pose and the settings leave.

use super::{MotionError, Prepared};
use crate::lights::{KnownLight, known_lights};
use crate::settings::lighting::Lighting;
use crate::settings::{Settings, VisibilityError};

/// Why nobody knows where the lights are.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LightsError {
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
}

impl Prepared {
    /// Something in the scene glows by itself, as far as the settings let it.
    pub fn emits(&self, lighting: &Lighting) -> bool {
        lighting.emission > 0.0 && self.brightest_emission > 0.0
    }

    /// Every light of the pose that settings ask for.
    pub fn known_lights(&self, settings: &Settings) -> Result<Vec<KnownLight>, LightsError> {
        let pose = self.pose(&settings.shot.motion)?;
        let shown = self.shown_nodes(&settings.shot.visibility, &pose)?;
        Ok(known_lights(&self.scene, &pose, &settings.method.lighting, &shown, self.emits(&settings.method.lighting)))
    }
}
