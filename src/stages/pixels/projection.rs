//! From the world to the picture, for triangles that are drawn.

use glam::{DMat3, DMat4, DVec3};

use crate::data::grid::Grid;
use crate::scene::OrbitCamera;

/// Where the triangles are drawn: the camera's axes, cells.
pub fn camera_from_world(camera: &OrbitCamera, grid: &Grid) -> DMat4 {
    DMat4::from_scale(DVec3::splat(1.0 / grid.span)) * camera.camera_from_world()
}

/// From that space to the picture's; depth is reversed. `farthest`: what is seen is no farther from the eye, scene units.
pub fn clip_from_camera(camera: &OrbitCamera, grid: &Grid, size_px: [u32; 2], farthest: f64) -> DMat4 {
    let projection = camera.projection(f64::from(size_px[0]) / f64::from(size_px[1]), farthest);
    projection * DMat4::from_scale(DVec3::splat(grid.span))
}

/// The camera's axes in the world, a column each, padded to four.
pub fn padded_axes(camera: &OrbitCamera) -> [[f32; 4]; 3] {
    let axes = DMat3::from_mat4(camera.world_from_camera());
    [0, 1, 2].map(|column| axes.col(column).as_vec3().extend(0.0).to_array())
}
