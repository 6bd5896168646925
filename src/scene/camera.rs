//! The inspector's camera: orbits a target.
//!
//! In: turns, shifts and boxes to look at. Out: f64 matrices that are always finite, whatever the
//! viewport or the scene. Depth is reversed, 1 at the near plane and 0 at infinity: float depth
//! then resolves far and near equally well. Clear it to 0, compare with `Greater`.

use glam::{DMat4, DVec3, DVec4};
use serde::{Deserialize, Serialize};

use super::{Aabb, Pose, Projection, Scene};

/// Right-handed, looks from `eye` to `target`. Never degenerate: see [`OrbitCamera::world_up`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrbitCamera {
    pub eye: DVec3,
    pub target: DVec3,
    /// Full vertical angle.
    pub fov_y_degrees: f64,
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
        Self { eye: DVec3::new(1.5, 1.2, 2.5), target: DVec3::ZERO, fov_y_degrees: DEFAULT_FOV_Y_DEGREES }
    }
}

impl OrbitCamera {
    /// World up, or another axis when looking straight along it: the one orbiting there leads to.
    pub fn world_up(&self) -> DVec3 {
        let forward = (self.target - self.eye).normalize_or(DVec3::NEG_Z);
        if forward.y.abs() > 0.9999 { DVec3::Z * forward.y.signum() } else { DVec3::Y }
    }

    /// Columns right, up, backward, eye.
    pub fn world_from_camera(&self) -> DMat4 {
        let backward = (self.eye - self.target).normalize_or(DVec3::Z);
        let right = self.world_up().cross(backward).normalize_or(DVec3::X);
        let up = backward.cross(right);
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
        let height = 2.0 * self.distance() * self.half_fov_tangent();
        let shift = (axes.x_axis * right_heights + axes.y_axis * up_heights).truncate() * height;
        self.eye += shift;
        self.target += shift;
    }

    /// Multiplies the distance to the target; below 1 comes nearer.
    pub fn zoom(&mut self, factor: f64) {
        if factor.is_finite() && factor > 0.0 {
            self.move_to(self.target, self.distance() * factor);
        }
    }

    /// Looks at a box from the side it looks from now, near enough to fill the view. Nothing counts
    /// as a unit sphere at the origin, a point as a sphere of one unit.
    pub fn frame(&mut self, bounds: Option<Aabb>, aspect: f64) {
        let bounds = bounds.filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite());
        let (center, radius) = bounds.map_or((DVec3::ZERO, 0.0), |b| (b.center(), b.size().length() / 2.0));
        let radius = if radius > 0.0 && radius.is_finite() { radius } else { 1.0 };
        let tangent = self.half_fov_tangent() * usable_aspect(aspect).min(1.0);
        self.move_to(center, radius / tangent.atan().sin());
    }

    /// Clip space from camera space for wgpu, reversed depth, near plane at a thousandth of the
    /// target's distance, far plane at infinity.
    pub fn projection(&self, aspect: f64) -> DMat4 {
        self.projection_between(aspect, NEAR_SHARE * self.distance(), f64::INFINITY)
    }

    /// The same between two planes, in scene units. A near plane that makes no sense is that of
    /// [`Self::projection`]; a far plane not beyond it is at infinity.
    pub fn projection_between(&self, aspect: f64, near: f64, far: f64) -> DMat4 {
        let near = if near.is_finite() && near > 0.0 { near } else { NEAR_SHARE * self.distance() };
        let depth_scale = if far > near { near / (far - near) } else { 0.0 };
        let y = 1.0 / self.half_fov_tangent();
        DMat4::from_cols(
            DVec4::X * (y / usable_aspect(aspect)),
            DVec4::Y * y,
            DVec4::new(0.0, 0.0, depth_scale, -1.0),
            DVec4::new(0.0, 0.0, near * (1.0 + depth_scale), 0.0),
        )
    }

    /// Keeps the direction.
    fn move_to(&mut self, target: DVec3, distance: f64) {
        let direction = (self.eye - self.target).normalize_or(DVec3::Z);
        let nearest = DISTANCES.0.max(NEAREST_SHARE * target.length());
        self.target = target;
        self.eye = target + direction * distance.clamp(nearest, DISTANCES.1.max(nearest));
    }

    fn half_fov_tangent(&self) -> f64 {
        let fov = if self.fov_y_degrees.is_finite() { self.fov_y_degrees } else { DEFAULT_FOV_Y_DEGREES };
        (fov.clamp(*FOV_Y_DEGREES.start(), *FOV_Y_DEGREES.end()).to_radians() / 2.0).tan()
    }
}

/// Width over height; a viewport without either counts as square, none as thinner than 1 : 10 000.
fn usable_aspect(aspect: f64) -> f64 {
    if aspect.is_finite() && aspect > 0.0 { aspect.clamp(1e-4, 1e4) } else { 1.0 }
}

/// The view of a camera of the file, as far as an orbiting camera can take it: its roll is lost, and
/// an orthographic one becomes a perspective that shows the same at its target. The target is where
/// the view passes the middle of the scene. `None` if no node with a usable matrix carries it.
pub fn camera_from_scene_camera(scene: &Scene, camera: usize, pose: &Pose) -> Option<OrbitCamera> {
    let lens = scene.cameras.get(camera)?.projection;
    let node = scene.nodes.iter().position(|node| node.camera == Some(camera))?;
    let world_from_node = pose.world_from_node.get(node)?;
    let place = world_from_node.w_axis.truncate();
    let forward = (-world_from_node.z_axis.truncate()).try_normalize()?;
    if !place.is_finite() {
        return None;
    }
    let ahead = scene.bounds_at(pose).map_or(1.0, |bounds| (bounds.center() - place).dot(forward));
    let target = place + forward * if ahead > DISTANCES.0 { ahead } else { 1.0 };
    Some(match lens {
        Projection::Perspective { fov_y_radians, .. } => {
            OrbitCamera { eye: place, target, fov_y_degrees: fov_y_radians.to_degrees() }
        }
        Projection::Orthographic { half_height, .. } => {
            let distance = half_height / (DEFAULT_FOV_Y_DEGREES.to_radians() / 2.0).tan();
            OrbitCamera { eye: target - forward * distance, target, fov_y_degrees: DEFAULT_FOV_Y_DEGREES }
        }
    })
}
