//! Everything a person can set. Window and command line fill the same struct, a screenshot carries
//! it, and the engine compares it with what was built to decide what a frame must do.

mod cone_tracing;
mod discretization;
mod format;
mod light_edit;
mod light_names;
pub mod lighting;
mod listed_names;
mod look;
mod motion;
mod node_names;
mod view;
mod visibility;

use serde::{Deserialize, Serialize};

pub use cone_tracing::ConeTracing;
pub use discretization::{Discretization, Filter, VoxelAnchor, VoxelizationMode};
pub use format::FORMAT;
pub use light_names::{LightChange, LightError};
pub use lighting::Lighting;
pub use look::{AlphaRule, ColorBy, Look, Lookup, Sampling, Slice, SliceAxis, SliceValue, ToneCurve};
pub use motion::MotionSettings;
pub use node_names::NodeNames;
pub use view::{SurfaceView, View};
pub use visibility::{Hidden, Visibility, VisibilityError};

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    pub discretization: Discretization,
    pub motion: MotionSettings,
    pub look: Look,
    pub visibility: Visibility,
    pub lighting: Lighting,
    pub cone_tracing: ConeTracing,
}

impl Settings {
    /// Are all values in range? If not, the sentence names value and range. Whoever takes settings
    /// from outside the program asks, before using them. Clip and nodes depend on the scene: whoever
    /// poses it finds out.
    pub fn check(&self) -> Result<(), String> {
        self.discretization.check()?;
        self.motion.check()?;
        self.lighting.check()?;
        self.cone_tracing.check()?;
        self.look.check(self.discretization.depth())
    }
}
