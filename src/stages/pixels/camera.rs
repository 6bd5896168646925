//! The rays of a picture's pixels, in grid space (Eq. 2), so that far-away scenes lose nothing.
//!
//! All is composed in f64. Rays start where the grid does: on the plane across the view direction
//! that touches the grid's circumscribed sphere, or at the eye if that is nearer. An eye a million
//! cells away then leaves f32 numbers of the grid's own size.

use glam::DVec3;

use crate::data::grid::Grid;
use crate::scene::OrbitCamera;

/// The ray of picture point (x, y), −1 … 1 to the right and up, in cells: origin + x·origin_x +
/// y·origin_y, and the direction alike (length 1 along the view direction).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRays {
    pub origin: DVec3,
    pub origin_x: DVec3,
    pub origin_y: DVec3,
    pub direction: DVec3,
    pub direction_x: DVec3,
    pub direction_y: DVec3,
    /// From the eye to the plane of the origins.
    pub start_cells: f64,
    pub size_px: [u32; 2],
}

/// One ray. Distances from the eye are `start_cells + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRay {
    pub origin: DVec3,
    /// Unit length.
    pub direction: DVec3,
    pub start_cells: f64,
    /// A pixel's width at t is `width + t·widening`, cells.
    pub width: f64,
    pub widening: f64,
}

impl PixelRays {
    pub fn new(camera: &OrbitCamera, grid: &Grid, size_px: [u32; 2]) -> Self {
        let half = camera.half_extents(f64::from(size_px[0]) / f64::from(size_px[1]));
        let axes = camera.world_from_camera();
        let forward = -axes.z_axis.truncate();
        let eye = grid.grid_from_world().transform_point3(axes.w_axis.truncate());
        let center = DVec3::splat(f64::from(grid.cells()) / 2.0);
        let start_cells = ((center - eye).dot(forward) - center.length()).max(0.0);
        let (across_x, across_y) = (axes.x_axis.truncate() * half.x, axes.y_axis.truncate() * half.y);
        // Rays of an orthographic camera are parallel, those of another meet in the eye.
        let (direction_x, direction_y, spread) = match camera.orthographic_height {
            Some(_) => (DVec3::ZERO, DVec3::ZERO, 1.0 / grid.span),
            None => (across_x, across_y, start_cells),
        };
        Self {
            origin: eye + forward * start_cells,
            origin_x: across_x * spread,
            origin_y: across_y * spread,
            direction: forward,
            direction_x,
            direction_y,
            start_cells,
            size_px,
        }
    }

    /// Through a point of the picture, in pixels from its upper left corner; a pixel's middle is at
    /// one half.
    pub fn ray(&self, point_px: [f64; 2]) -> PixelRay {
        let [width, height] = self.size_px.map(f64::from);
        let (x, y) = (2.0 * point_px[0] / width - 1.0, 1.0 - 2.0 * point_px[1] / height);
        let across = self.direction + self.direction_x * x + self.direction_y * y;
        let steepness = across.length();
        PixelRay {
            origin: self.origin + self.origin_x * x + self.origin_y * y,
            direction: across / steepness,
            start_cells: self.start_cells * steepness,
            width: 2.0 * self.origin_y.length() / height,
            widening: 2.0 * self.direction_y.length() / height / steepness,
        }
    }

    /// The inverse of [`Self::ray`]: where a point of the grid is in the picture, in pixels, and its depth
    /// along the view direction, cells. `None` behind the eye, or so close to its plane that it is nowhere.
    pub fn project(&self, point_cells: DVec3) -> Option<([f64; 2], f64)> {
        const LEAST_DEPTH_CELLS: f64 = 1e-3;
        let from_eye = point_cells - (self.origin - self.direction * self.start_cells);
        let depth = from_eye.dot(self.direction);
        if depth.is_nan() || depth < LEAST_DEPTH_CELLS {
            return None;
        }
        // From the middle of the picture to its edges, at this depth.
        let beyond = depth - self.start_cells;
        let along = |axis: DVec3| from_eye.dot(axis) / axis.length_squared();
        let [width, height] = self.size_px.map(f64::from);
        let x = along(self.origin_x + self.direction_x * beyond);
        let y = along(self.origin_y + self.direction_y * beyond);
        Some(([(x + 1.0) / 2.0 * width, (1.0 - y) / 2.0 * height], depth))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::IVec3;

    #[test]
    fn points_on_a_pixels_ray_are_projected_to_that_pixel() {
        let grid =
            Grid { anchor: DVec3::new(3.0, -1.0, 0.5), offset_cells: IVec3::new(-5, 2, 1), span: 0.125, depth: 6 };
        let corner = grid.corner();
        for (eye, target) in [
            (corner + DVec3::new(4.0, 3.0, 2.0), corner + 4.0),
            (corner + DVec3::new(400.0, -300.0, 5.0), corner + 4.0),
            (corner + DVec3::new(1.0, 1e6, 1.0), corner),
        ] {
            let perspective = OrbitCamera { roll_degrees: 25.0, ..OrbitCamera::new(eye, target, 40.0) };
            for camera in [perspective, OrbitCamera { orthographic_height: Some(3.0), ..perspective }] {
                let rays = PixelRays::new(&camera, &grid, [640, 360]);
                for point_px in [[0.5, 0.5], [320.0, 180.0], [639.5, 17.25], [100.0, 359.0]] {
                    let ray = rays.ray(point_px);
                    for t in [0.5, 20.0, 3000.0] {
                        let ([x, y], depth) =
                            rays.project(ray.origin + ray.direction * t).expect("in front of the eye");
                        // A million spans away, a cell is 1e-10 of the numbers it is computed from.
                        let error_px = (x - point_px[0]).abs().max((y - point_px[1]).abs());
                        assert!(
                            error_px < 1e-6 && depth > 0.0,
                            "{eye}: {point_px:?} at {t} is off by {error_px} pixels"
                        );
                    }
                }
                let behind = rays.ray([320.0, 180.0]);
                assert_eq!(rays.project(behind.origin - behind.direction * (behind.start_cells + 2.0)), None);
            }
        }
    }
}
