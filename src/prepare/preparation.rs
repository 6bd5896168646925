//! What a scene is voxelized for.

use crate::settings::{Discretization, Fit, FitTo, MotionSettings, Settings};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preparation {
    pub discretization: Discretization,
    /// The clip that is played, and the moment for a grid that fits that alone.
    pub motion: MotionSettings,
    pub fit: Fit,
}

impl Preparation {
    /// Whether both need the same grid and the same voxels.
    pub fn same_voxels(&self, other: &Self) -> bool {
        let moment = |this: &Self| (this.fit.to == FitTo::Pose).then_some(this.motion.time_secs);
        self.same_but_for_its_moment(other) && moment(self) == moment(other)
    }

    /// Whether a grid that fits a pose is all that can differ, because another pose is shown.
    pub fn same_but_for_its_moment(&self, other: &Self) -> bool {
        let chosen = |this: &Self| {
            let Discretization { grid, span, mode, weights, .. } = this.discretization;
            (grid, span, mode, weights, this.motion.clip.clone(), this.fit.clone())
        };
        chosen(self) == chosen(other)
    }

    /// Puts what voxels were made for into settings that wish for others.
    pub fn keep_in(&self, settings: &mut Settings) {
        let (made, wanted) = (&self.discretization, &mut settings.method.discretization);
        (wanted.grid, wanted.span) = (made.grid, made.span);
        (wanted.mode, wanted.weights) = (made.mode, made.weights);
        settings.shot.fit.clone_from(&self.fit);
    }
}

impl From<&Discretization> for Preparation {
    fn from(discretization: &Discretization) -> Self {
        Self { discretization: *discretization, ..Self::default() }
    }
}

impl From<&Settings> for Preparation {
    fn from(settings: &Settings) -> Self {
        Self {
            discretization: settings.method.discretization,
            motion: settings.shot.motion.clone(),
            fit: settings.shot.fit.clone(),
        }
    }
}
