//! A posed triangle, and where a line meets it (Möller and Trumbore), in f64.

use glam::DVec3;

/// Share of a triangle by which an edge may be missed: what f64 rounds in the weights.
const EDGE_SLACK: f64 = 1e-12;

/// Corners in cells from the grid's corner.
pub struct PosedTriangle {
    pub corners: [DVec3; 3],
    pub vertices: [u32; 3],
    /// The primitive of an object that it belongs to.
    pub surface: u32,
}

impl PosedTriangle {
    /// Along its normal.
    pub fn doubled_area(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Where a line meets it: how far along, and the weights of the corners, together 1. Edges belong to
    /// it, so that nothing gets through between neighbours.
    pub fn meets(&self, origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            return None;
        }
        let from_a = origin - a;
        let v = from_a.dot(across) / determinant;
        let beside = from_a.cross(ab);
        let w = direction.dot(beside) / determinant;
        let place = DVec3::new(1.0 - v - w, v, w);
        (place.min_element() >= -EDGE_SLACK).then(|| (ac.dot(beside) / determinant, place))
    }
}

/// What corners have, blended by weights that are together 1.
pub fn weighted([a, b, c]: [DVec3; 3], place: DVec3) -> DVec3 {
    a * place.x + b * place.y + c * place.z
}
