//! Where an orbiting camera goes to see all of a box.

use glam::{DMat3, DVec3};

use super::Aabb;
use super::camera::{OrbitCamera, usable_aspect};

/// Of the picture, what is framed leaves this much more around it.
const MARGIN: f64 = 1.05;
/// Places of the box on its way around the axis that it is orbited about.
const AZIMUTHS: u32 = 32;

impl OrbitCamera {
    /// From the front, the right and above.
    pub fn framing(bounds: Option<Aabb>, aspect: f64) -> Self {
        let mut camera = Self::default();
        camera.frame(bounds, aspect);
        camera
    }

    /// Looks at a box from the side it looks from now, near enough to fill the view, and far enough to see all of it
    /// wherever it is orbited to sideways. Nothing counts as a unit sphere at the origin, a point as a sphere of one unit.
    pub fn frame(&mut self, bounds: Option<Aabb>, aspect: f64) {
        let bounds = bounds.filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite());
        let (center, half) = bounds.map_or((DVec3::ZERO, DVec3::ZERO), |b| (b.center(), b.size() / 2.0));
        let half =
            if half.length() > 0.0 && half.length().is_finite() { half } else { DVec3::splat(1.0 / 3_f64.sqrt()) };
        let camera_from_world = DMat3::from_mat4(self.camera_from_world());
        let extents = self.half_extents(aspect);
        let side = self.eye - self.target;
        let places = around(half, side.x.atan2(side.z)).map(|place| camera_from_world * place);
        if let Some(height) = &mut self.orthographic_height {
            let highest = places.map(|place| place.y.abs().max(place.x.abs() / usable_aspect(aspect)));
            *height = 2.0 * MARGIN * highest.fold(0.0, f64::max);
            self.move_to(center, 2.0 * half.length());
        } else {
            let distance = |place: DVec3| place.z + (place.x.abs() / extents.x).max(place.y.abs() / extents.y);
            self.move_to(center, MARGIN * places.map(distance).fold(0.0, f64::max));
        }
    }
}

/// A cylinder about the vertical that holds a box of these half edges at every azimuth; seen alike from each.
fn around(half: DVec3, azimuth_rad: f64) -> impl Iterator<Item = DVec3> {
    // A polygon around the circle reaches farther than it.
    let radius = half.x.hypot(half.z) / (std::f64::consts::PI / f64::from(AZIMUTHS)).cos();
    (0..2 * AZIMUTHS).map(move |place| {
        let turn = std::f64::consts::TAU * f64::from(place / 2) / f64::from(AZIMUTHS);
        let (sin, cos) = (azimuth_rad + turn).sin_cos();
        DVec3::new(radius * sin, if place % 2 == 0 { half.y } else { -half.y }, radius * cos)
    })
}
