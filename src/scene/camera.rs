//! The inspector's camera: orbits a target.
//!
//! In: turns, shifts and boxes to look at. Out: f64 matrices that are always finite, whatever the
//! viewport or the scene. Depth is reversed, 1 at the near plane and 0 at infinity: float depth
//! then resolves far and near equally well. Clear it to 0, compare with `Greater`.

use glam::{DMat4, DVec2, DVec3, DVec4};
use serde::{Deserialize, Serialize};

/// Right-handed, looks from `eye` to `target`. Never degenerate: see [`OrbitCamera::world_up`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OrbitCamera {
    pub eye: DVec3,
    pub target: DVec3,
    /// Full vertical angle of a perspective view.
    pub fov_y_degrees: f64,
    /// By how much the camera is turned about its line of sight, to the left as it sees it itself.
    #[serde(default, skip_serializing_if = "is_upright")]
    pub roll_degrees: f64,
    /// Height of what an orthographic view shows, scene units; `None`: perspective. What lies behind the eye is seen
    /// by neither.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orthographic_height: Option<f64>,
}

fn is_upright(roll_degrees: &f64) -> bool {
    *roll_degrees == 0.0
}

const DEFAULT_FOV_Y_DEGREES: f64 = 45.0;
/// Outside of these, perspective is no picture any more.
pub const FOV_Y_DEGREES: std::ops::RangeInclusive<f64> = 1.0..=170.0;
/// Orbiting stops short of the poles, where up would flip.
const MAX_ELEVATION_RADIANS: f64 = 89.0 * std::f64::consts::PI / 180.0;
/// The near plane's distance as a share of the target's.
const NEAR_SHARE: f64 = 1e-3;
/// The eye comes no nearer to its target than this share of the target's distance from the origin:
/// closer, the two could round to one point.
const NEAREST_SHARE: f64 = 1e-9;
/// Distances stay within what an f32 can hold when squared.
const DISTANCES: (f64, f64) = (1e-15, 1e15);

impl Default for OrbitCamera {
    /// Looks at the origin from the front, the right and above.
    fn default() -> Self {
        Self::new(DVec3::new(1.5, 1.2, 2.5), DVec3::ZERO, DEFAULT_FOV_Y_DEGREES)
    }
}

impl OrbitCamera {
    /// Perspective and upright.
    pub const fn new(eye: DVec3, target: DVec3, fov_y_degrees: f64) -> Self {
        Self { eye, target, fov_y_degrees, roll_degrees: 0.0, orthographic_height: None }
    }

    /// World up, or another axis when looking straight along it: the one orbiting there leads to.
    pub fn world_up(&self) -> DVec3 {
        let forward = (self.target - self.eye).normalize_or(DVec3::NEG_Z);
        if forward.y.abs() > 0.9999 { DVec3::Z * forward.y.signum() } else { DVec3::Y }
    }

    /// Columns right, up, backward, eye.
    pub fn world_from_camera(&self) -> DMat4 {
        let backward = (self.eye - self.target).normalize_or(DVec3::Z);
        let level = self.world_up().cross(backward).normalize_or(DVec3::X);
        let upright = backward.cross(level);
        let roll = if self.roll_degrees.is_finite() { self.roll_degrees.to_radians() } else { 0.0 };
        let (right, up) = (level * roll.cos() + upright * roll.sin(), upright * roll.cos() - level * roll.sin());
        DMat4::from_cols(right.extend(0.0), up.extend(0.0), backward.extend(0.0), self.eye.extend(1.0))
    }

    pub fn camera_from_world(&self) -> DMat4 {
        self.world_from_camera().inverse()
    }

    /// From eye to target in scene units, never 0.
    pub fn distance(&self) -> f64 {
        let distance = self.eye.distance(self.target);
        if distance.is_finite() && distance > 0.0 { distance } else { 1.0 }
    }

    /// Turns about the target: `yaw` to the right around world up, `pitch` upwards, short of the poles.
    pub fn orbit(&mut self, yaw_radians: f64, pitch_radians: f64) {
        if !(yaw_radians.is_finite() && pitch_radians.is_finite()) {
            return;
        }
        let distance = self.distance();
        let offset = (self.eye - self.target).normalize_or(DVec3::Z);
        let azimuth = offset.x.atan2(offset.z) + yaw_radians;
        let elevation =
            (offset.y.clamp(-1.0, 1.0).asin() + pitch_radians).clamp(-MAX_ELEVATION_RADIANS, MAX_ELEVATION_RADIANS);
        let direction = DVec3::new(elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos());
        self.eye = self.target + direction * distance;
    }

    /// Shifts eye and target in the image plane, by heights of the view at the target. What is not
    /// finite (a drag over a viewport of no size) shifts nothing.
    pub fn pan(&mut self, right_heights: f64, up_heights: f64) {
        if !(right_heights.is_finite() && up_heights.is_finite()) {
            return;
        }
        let axes = self.world_from_camera();
        let height = 2.0 * self.half_height();
        let shift = (axes.x_axis * right_heights + axes.y_axis * up_heights).truncate() * height;
        self.eye += shift;
        self.target += shift;
    }

    /// Multiplies the distance to the target, or the height of an orthographic view; below 1 comes nearer.
    pub fn zoom(&mut self, factor: f64) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        match &mut self.orthographic_height {
            Some(height) => *height = (*height * factor).clamp(DISTANCES.0, DISTANCES.1),
            None => self.move_to(self.target, self.distance() * factor),
        }
    }

    /// Shows as much to the sides as a picture of aspect `shown`, in one of aspect `aspect`: more above and below where
    /// that is narrower.
    pub fn widen(&mut self, shown: f64, aspect: f64) {
        let factor = (usable_aspect(shown) / usable_aspect(aspect)).max(1.0);
        match &mut self.orthographic_height {
            Some(height) => *height *= factor,
            None => self.fov_y_degrees = 2.0 * (self.half_fov_tangent() * factor).atan().to_degrees(),
        }
    }

    /// Another lens that shows as much at the target, from the same side.
    pub fn set_orthographic(&mut self, orthographic: bool) {
        let half_height = self.half_height();
        self.orthographic_height = orthographic.then_some(2.0 * half_height);
        if !orthographic {
            self.move_to(self.target, half_height / self.half_fov_tangent());
        }
    }

    /// Half of the width and of the height that a picture shows: one unit ahead of a perspective camera, anywhere ahead
    /// of an orthographic one. Scene units.
    pub fn half_extents(&self, aspect: f64) -> DVec2 {
        let half_height = match self.orthographic_height {
            Some(_) => self.half_height(),
            None => self.half_fov_tangent(),
        };
        DVec2::new(half_height * usable_aspect(aspect), half_height)
    }

    /// From the eye to the plane before which nothing is seen: a thousandth of the target's distance, and the eye's own
    /// plane for an orthographic camera. Scene units.
    pub fn near(&self) -> f64 {
        if self.orthographic_height.is_some() { 0.0 } else { NEAR_SHARE * self.distance() }
    }

    /// Clip space from camera space for wgpu, reversed depth. The far plane is at infinity, or at `farthest` scene units
    /// from an orthographic camera.
    pub fn projection(&self, aspect: f64, farthest: f64) -> DMat4 {
        let half = self.half_extents(aspect);
        let (x, y) = (DVec4::X / half.x, DVec4::Y / half.y);
        if self.orthographic_height.is_none() {
            return DMat4::from_cols(x, y, DVec4::NEG_W, DVec4::Z * self.near());
        }
        // A little behind what is farthest, which would be nowhere at depth 0.
        let reach = if farthest.is_finite() { farthest.max(DISTANCES.0) * (1.0 + NEAR_SHARE) } else { DISTANCES.1 };
        DMat4::from_cols(x, y, DVec4::Z / reach, DVec4::new(0.0, 0.0, 1.0, 1.0))
    }

    /// Keeps the direction.
    pub(super) fn move_to(&mut self, target: DVec3, distance: f64) {
        let direction = (self.eye - self.target).normalize_or(DVec3::Z);
        let nearest = DISTANCES.0.max(NEAREST_SHARE * target.length());
        self.target = target;
        self.eye = target + direction * distance.clamp(nearest, DISTANCES.1.max(nearest));
    }

    /// Half of the height that is shown at the target's distance, scene units.
    fn half_height(&self) -> f64 {
        match self.orthographic_height {
            Some(height) if height.is_finite() && height > 0.0 => height / 2.0,
            _ => self.distance() * self.half_fov_tangent(),
        }
    }

    fn half_fov_tangent(&self) -> f64 {
        let fov = if self.fov_y_degrees.is_finite() { self.fov_y_degrees } else { DEFAULT_FOV_Y_DEGREES };
        (fov.clamp(*FOV_Y_DEGREES.start(), *FOV_Y_DEGREES.end()).to_radians() / 2.0).tan()
    }
}

/// Width over height; a viewport without either counts as square, none as thinner than 1 : 10 000.
pub(super) fn usable_aspect(aspect: f64) -> f64 {
    if aspect.is_finite() && aspect > 0.0 { aspect.clamp(1e-4, 1e4) } else { 1.0 }
}
