//! What moved voxels, their shadows and their cones get wrong, beside what they cost.

pub mod race;
pub mod rendering;
pub mod shadows;
pub mod traced;
pub mod voxels;

use super::lab::Lab;
use crate::settings::{MotionSettings, Settings};

/// The settings of one of the poses.
fn posed(lab: &Lab, pose: &MotionSettings) -> Settings {
    Settings { motion: pose.clone(), ..lab.settings.clone() }
}

/// What pictures of a pose are called, as far as they have that in common.
fn picture_stem(lab: &Lab, settings: &Settings, number: usize) -> String {
    format!("{}-{}-{number}", lab.prepared.scene.name, settings.discretization.grid)
}
