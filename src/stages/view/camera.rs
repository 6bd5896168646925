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
        let projection = camera.projection(f64::from(size_px[0]) / f64::from(size_px[1]));
        let axes = camera.world_from_camera();
        let forward = -axes.z_axis.truncate();
        let eye = grid.grid_from_world().transform_point3(axes.w_axis.truncate());
        let center = DVec3::splat(f64::from(grid.cells()) / 2.0);
        let start_cells = ((center - eye).dot(forward) - center.length()).max(0.0);
        let direction_x = axes.x_axis.truncate() / projection.x_axis.x;
        let direction_y = axes.y_axis.truncate() / projection.y_axis.y;
        Self {
            origin: eye + forward * start_cells,
            origin_x: direction_x * start_cells,
            origin_y: direction_y * start_cells,
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
}
