//! Cameras of the file as cameras that orbit: where their nodes are in a pose, with their roll, and orthographic where
//! they are.

use glam::DVec3;

use super::camera::FOV_Y_DEGREES;
use super::{OrbitCamera, Pose, Scene};

/// A camera of the file; its pose is that of the node that carries it.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneCamera {
    pub name: String,
    pub projection: Projection,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// `aspect`: width over height; `None`: that of whatever picture is taken.
    Perspective {
        fov_y_radians: f64,
        aspect: Option<f64>,
        near: f64,
        far: Option<f64>,
    },
    Orthographic {
        half_width: f64,
        half_height: f64,
        near: f64,
        far: f64,
    },
}

impl Projection {
    /// Width over height of its picture, where the file says.
    pub fn aspect(&self) -> Option<f64> {
        match *self {
            Self::Perspective { aspect, .. } => aspect,
            Self::Orthographic { half_width, half_height, .. } => Some(half_width / half_height),
        }
    }
}

impl Scene {
    /// What a camera of the file sees in a picture of `aspect` (width over height): all that its own picture shows, and
    /// more on two sides where the aspects differ. Its target is where the view passes the middle of the scene. `None`
    /// if no node with a usable matrix carries it.
    pub fn camera_at(&self, camera: usize, pose: &Pose, aspect: f64) -> Option<OrbitCamera> {
        let lens = self.cameras.get(camera)?.projection;
        let node = self.nodes.iter().position(|node| node.camera == Some(camera))?;
        let world_from_node = pose.world_from_node.get(node)?;
        let eye = world_from_node.w_axis.truncate();
        let forward = (-world_from_node.z_axis.truncate()).try_normalize()?;
        if !eye.is_finite() {
            return None;
        }
        let ahead = self.bounds_at(pose).map_or(1.0, |bounds| (bounds.center() - eye).dot(forward));
        let target = eye + forward * if ahead > f64::EPSILON { ahead } else { 1.0 };
        let mut seen = OrbitCamera { eye, target, ..OrbitCamera::default() };
        match lens {
            Projection::Perspective { fov_y_radians, .. } => seen.fov_y_degrees = fov_y_radians.to_degrees(),
            Projection::Orthographic { half_height, .. } => seen.orthographic_height = Some(2.0 * half_height),
        }
        seen.roll_degrees = roll_degrees(&seen, world_from_node.y_axis.truncate());
        if let Some(own) = lens.aspect() {
            seen.widen(own, aspect);
        }
        seen.fov_y_degrees = seen.fov_y_degrees.clamp(*FOV_Y_DEGREES.start(), *FOV_Y_DEGREES.end());
        Some(seen)
    }
}

/// By how much an upright camera must be turned so that `up` is up in its picture.
fn roll_degrees(upright: &OrbitCamera, up: DVec3) -> f64 {
    /// What rounding makes of an upright camera of the file.
    const UPRIGHT_DEGREES: f64 = 1e-4;
    let axes = upright.world_from_camera();
    let roll = (-up.dot(axes.x_axis.truncate())).atan2(up.dot(axes.y_axis.truncate())).to_degrees();
    if roll.is_finite() && roll.abs() > UPRIGHT_DEGREES { roll } else { 0.0 }
}
