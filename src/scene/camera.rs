//! The inspector's camera: orbits a target.

use glam::{DMat4, DVec3};
use serde::{Deserialize, Serialize};

/// Right-handed, looks from `eye` to `target`. Never degenerate: see [`OrbitCamera::world_up`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrbitCamera {
    pub eye: DVec3,
    pub target: DVec3,
    /// Full vertical angle.
    pub fov_y_degrees: f64,
}

impl OrbitCamera {
    /// World up, or another axis when looking straight along it.
    pub fn world_up(&self) -> DVec3 {
        let forward = (self.target - self.eye).normalize_or(DVec3::NEG_Z);
        if forward.y.abs() > 0.9999 { DVec3::NEG_Z * forward.y.signum() } else { DVec3::Y }
    }

    /// Columns right, up, backward, eye.
    pub fn world_from_camera(&self) -> DMat4 {
        let backward = (self.eye - self.target).normalize_or(DVec3::Z);
        let right = self.world_up().cross(backward).normalize_or(DVec3::X);
        let up = backward.cross(right);
        DMat4::from_cols(right.extend(0.0), up.extend(0.0), backward.extend(0.0), self.eye.extend(1.0))
    }
}
