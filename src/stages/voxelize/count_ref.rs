//! Reference of counting columns, in f64.

use glam::DVec3;

use super::triangle::Triangle;

/// Columns along the dominant axis that a triangle's bounds reach in a grid of `grid_cells`; corners in cells from its
/// corner.
pub fn column_count(corners: [DVec3; 3], grid_cells: u32) -> u32 {
    let Some(triangle) = Triangle::new(&corners, [0, 1, 2]) else { return 0 };
    let range = |axis: usize| {
        let values = corners.map(|corner| corner[axis]);
        let least = values.into_iter().fold(f64::INFINITY, f64::min).floor();
        // A single integer belongs to the cell above it.
        let most = (values.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil() - 1.0).max(least);
        (most.min(f64::from(grid_cells) - 1.0) - least.max(0.0) + 1.0).max(0.0)
    };
    let axis = triangle.dominant_axis();
    if range(axis) == 0.0 { 0 } else { (range((axis + 1) % 3) * range((axis + 2) % 3)) as u32 }
}
