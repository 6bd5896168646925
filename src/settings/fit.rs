//! What the grid encloses.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::Visibility;

/// What the grid encloses, unless a span says how large its cells are: then what it is centred on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fit {
    pub to: FitTo,
    /// What counts. Kept apart from what is shown, so that hiding something moves no grid.
    pub counted: Visibility,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FitTo {
    /// Everything, at rest and over all clips.
    Scene,
    /// What counts, over the clip that is played. Small things far from the rest do not.
    #[default]
    Clip,
    /// What counts, at the moment that is shown. Small things far from the rest do not.
    Pose,
    /// A box, scene units.
    Box { min: DVec3, max: DVec3 },
}

impl Fit {
    pub(super) fn check(&self) -> Result<(), String> {
        match self.to {
            FitTo::Box { min, max } if !(min.is_finite() && max.is_finite() && min.cmplt(max).all()) => {
                Err(format!("a box from {min} to {max} has no finite extent along each axis"))
            }
            _ => Ok(()),
        }
    }
}
