//! Everything a person can set. Window and command line fill the same struct, a screenshot carries
//! it, and the engine compares it with what was built to decide what a frame must do.

mod cone_tracing;
mod discretization;
mod fit;
mod format;
mod format_1;
mod light_edit;
mod light_names;
pub mod lighting;
mod listed_names;
mod look;
mod method;
mod motion;
mod node_names;
mod shot;
mod view;
mod visibility;

pub use cone_tracing::ConeTracing;
pub use discretization::{
    Discretization, Discretizer, Filter, JointWeights, Stretching, VoxelAnchor, VoxelizationMode, VoxelizerCells,
};
pub use fit::{Fit, FitTo};
pub use format::FORMAT;
pub use light_names::{LightChange, LightError};
pub use lighting::Lighting;
pub use look::{AlphaRule, ColorBy, Look, Lookup, Sampling, Slice, SliceAxis, SliceValue, ToneCurve};
pub use method::MethodSettings;
pub use motion::MotionSettings;
pub use node_names::NodeNames;
pub use shot::ShotSettings;
pub use view::{SurfaceView, View};
pub use visibility::{Hidden, Visibility, VisibilityError};

/// What is looked at, and how it is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    pub shot: ShotSettings,
    pub method: MethodSettings,
}

impl Settings {
    /// Are all values in range? If not, the sentence names value and range. Whoever takes settings
    /// from outside the program asks, before using them. Clip and nodes depend on the scene: whoever
    /// poses it finds out.
    pub fn check(&self) -> Result<(), String> {
        self.shot.check()?;
        self.method.check()
    }
}
