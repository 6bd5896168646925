//! Rays from the eye through a picture, in cells, from the near plane on: as the surface image is drawn.

use glam::DVec3;

use crate::accuracy::ray_tree::Segment;
use crate::data::grid::Grid;
use crate::scene::OrbitCamera;

pub struct CameraRays {
    pub eye: DVec3,
    pub forward: DVec3,
    /// From the middle of the picture to its right and upper edge: one cell ahead of a perspective camera, anywhere
    /// ahead of an orthographic one.
    pub right: DVec3,
    pub up: DVec3,
    pub is_orthographic: bool,
    pub near_cells: f64,
    pub size_px: [f64; 2],
}

impl CameraRays {
    pub fn new(camera: &OrbitCamera, grid: &Grid, size_px: [u32; 2]) -> Self {
        let size_px = size_px.map(f64::from);
        let half = camera.half_extents(size_px[0] / size_px[1]);
        let is_orthographic = camera.orthographic_height.is_some();
        let unit = if is_orthographic { 1.0 / grid.span } else { 1.0 };
        let axes = camera.world_from_camera();
        Self {
            eye: grid.grid_from_world().transform_point3(axes.w_axis.truncate()),
            forward: -axes.z_axis.truncate(),
            right: axes.x_axis.truncate() * half.x * unit,
            up: axes.y_axis.truncate() * half.y * unit,
            is_orthographic,
            near_cells: camera.near() / grid.span,
            size_px,
        }
    }

    /// Through a point in pixels from the upper left corner. Its distances count from the near plane.
    pub fn through(&self, [x, y]: [f64; 2]) -> Segment {
        let (x, y) = (2.0 * x / self.size_px[0] - 1.0, 1.0 - 2.0 * y / self.size_px[1]);
        let aside = self.right * x + self.up * y;
        if self.is_orthographic {
            return Segment { from: self.eye + aside, direction: self.forward, length: f64::INFINITY };
        }
        let across = self.forward + aside;
        let from = self.eye + across * self.near_cells;
        Segment { from, direction: across.normalize(), length: f64::INFINITY }
    }
}
