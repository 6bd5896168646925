//! A triangle's plane over the columns of cells along its dominant axis.
//!
//! In: corners in axes (u, v, w), w dominant. Out: the cells of a column that meet the plane.
//! Estimated heights decide where their error bound allows, else the exact predicate does.

use crate::settings::VoxelizationMode;

/// The triangle's plane as heights along w over columns (u, v), slopes at most 1.
pub(super) struct Plane {
    mode: VoxelizationMode,
    corners: [[f64; 3]; 3],
    counter_clockwise: bool,
    slope: [f64; 2],
    /// Bound on the error of an estimated height, in cells; infinite where only the predicate knows.
    height_error: f64,
    /// Where in a column the plane is lowest and highest, from the column's lower corner.
    lowest: [f64; 2],
    highest: [f64; 2],
}

impl Plane {
    pub fn new(corners: [[f64; 3]; 3], areas: [f64; 3], mode: VoxelizationMode) -> Self {
        let slope = [-areas[0] / areas[2], -areas[1] / areas[2]];
        let lowest = match mode {
            VoxelizationMode::Conservative => slope.map(|s| if s > 0.0 { 0.0 } else { 1.0 }),
            VoxelizationMode::Thin => [0.5; 2],
        };
        let highest = lowest.map(|offset| 1.0 - offset);
        let counter_clockwise = areas[2] > 0.0;
        let height_error = height_error(corners, areas[2]);
        Self { mode, corners, counter_clockwise, slope, height_error, lowest, highest }
    }

    fn height(&self, u: i32, v: i32, offset: [f64; 2]) -> f64 {
        let [u0, v0, w0] = self.corners[0];
        let along_u = f64::from(u) + offset[0] - u0;
        let along_v = f64::from(v) + offset[1] - v0;
        w0 + self.slope[0] * along_u + self.slope[1] * along_v
    }

    /// Cells of a column that may meet the plane, inclusive; saturates where the bound is infinite.
    pub fn candidates(&self, u: i32, v: i32) -> [i32; 2] {
        let low = self.height(u, v, self.lowest) - self.height_error;
        let high = self.height(u, v, self.highest) + self.height_error;
        [(low.ceil() as i32).saturating_sub(1), high.floor() as i32]
    }

    /// Conservative: the open cell meets the plane. Thin: the closed axis of the cell along w does.
    pub fn meets(&self, u: i32, v: i32, w: i32) -> bool {
        let (bottom, top) = (f64::from(w), f64::from(w) + 1.0);
        let low = self.height(u, v, self.lowest);
        let high = self.height(u, v, self.highest);
        if low + self.height_error < top && high - self.height_error > bottom {
            return true;
        }
        let below_top = self.above(u, v, self.lowest, top);
        let above_bottom = self.above(u, v, self.highest, bottom);
        match self.mode {
            VoxelizationMode::Conservative => below_top > 0.0 && above_bottom < 0.0,
            VoxelizationMode::Thin => below_top >= 0.0 && above_bottom <= 0.0,
        }
    }

    /// Positive where the point at height `w` lies above the plane, exact in sign.
    fn above(&self, u: i32, v: i32, offset: [f64; 2], w: f64) -> f64 {
        let coord = |p: [f64; 3]| robust::Coord3D { x: p[0], y: p[1], z: p[2] };
        let [a, b, c] = self.corners.map(coord);
        let point = coord([f64::from(u) + offset[0], f64::from(v) + offset[1], w]);
        let below = robust::orient3d(a, b, c, point);
        if self.counter_clockwise { -below } else { below }
    }
}

/// How far an estimated height may be off. The normal's components are differences of products of
/// edges, so their error is relative to the bounds, not to the area: large for slivers.
fn height_error(corners: [[f64; 3]; 3], area: f64) -> f64 {
    let extent = [0, 1, 2].map(|k| {
        let [a, b, c] = corners.map(|corner| corner[k]);
        a.max(b).max(c) - a.min(b).min(c)
    });
    let products = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
    let relative = 8.0 * f64::EPSILON * products / area.abs();
    if relative > 0.125 {
        return f64::INFINITY;
    }
    let magnitude = corners.iter().flatten().fold(1.0, |max: f64, c| max.max(c.abs()));
    4.0 * relative * (extent[0] + extent[1] + 2.0) + 16.0 * f64::EPSILON * (magnitude + extent[0] + extent[1])
}
