//! The moment that is looked at.

use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MotionSettings {
    /// Clip by name; `None`: the first one. An empty name: the rest pose.
    pub clip: Option<String>,
    pub time_secs: f64,
    /// Turns the whole scene about its centre, x, then y, then z axis, after voxelization: a rigid motion of everything.
    pub turn_degrees: [f64; 3],
}

impl MotionSettings {
    pub(super) fn check(&self) -> Result<(), String> {
        if !(self.time_secs.is_finite() && self.time_secs >= 0.0) {
            return Err(format!("a time of {} seconds is not a finite number from 0", self.time_secs));
        }
        if !self.turn_degrees.iter().all(|angle| angle.is_finite()) {
            return Err(format!("a turn of {:?} degrees is not finite", self.turn_degrees));
        }
        Ok(())
    }
}

impl Default for MotionSettings {
    fn default() -> Self {
        Self { clip: None, time_secs: 0.0, turn_degrees: [0.0; 3] }
    }
}
