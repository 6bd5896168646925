//! The part of a triangle inside a cell (Sutherland & Hodgman): its area and its centroid.

use glam::{DVec3, IVec3};

use super::triangle::Triangle;

/// Three corners, and one more for each of six planes.
const MAX_CORNERS: usize = 9;

/// Area in cells² and barycentric centroid of a triangle's part in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub area: f64,
    /// Weights of the triangle's corners; they sum to 1 up to rounding and are never negative.
    pub centroid: DVec3,
}

#[derive(Clone, Copy, Default)]
struct Corner {
    position: DVec3,
    barycentric: DVec3,
}

struct Polygon {
    corners: [Corner; MAX_CORNERS],
    len: usize,
}

/// The part of `triangle` in `cell`. Where rounding leaves no area of it, the area is zero and the
/// centroid the triangle's own.
pub(super) fn clip_to_cell(triangle: &Triangle, cell: IVec3) -> Piece {
    let mut polygon = Polygon { corners: Default::default(), len: 3 };
    for (corner, (&position, barycentric)) in
        polygon.corners.iter_mut().zip(triangle.corners.iter().zip([DVec3::X, DVec3::Y, DVec3::Z]))
    {
        *corner = Corner { position, barycentric };
    }
    for axis in 0..3 {
        let low = f64::from(cell[axis]);
        polygon = polygon.keep(|p| p[axis] - low);
        polygon = polygon.keep(|p| low + 1.0 - p[axis]);
    }
    polygon.piece(DVec3::from_array(triangle.projected_areas).normalize_or_zero())
}

impl Polygon {
    /// Cuts off where `distance` is negative.
    fn keep(self, distance: impl Fn(DVec3) -> f64) -> Self {
        let corners = &self.corners[..self.len];
        if corners.iter().all(|corner| distance(corner.position) >= 0.0) {
            return self;
        }
        let mut kept = Self { corners: Default::default(), len: 0 };
        for (i, &to) in corners.iter().enumerate() {
            let from = corners[(i + self.len - 1) % self.len];
            let (d_from, d_to) = (distance(from.position), distance(to.position));
            if (d_from < 0.0) != (d_to < 0.0) {
                let t = d_from / (d_from - d_to);
                kept.push(Corner {
                    position: from.position.lerp(to.position, t),
                    barycentric: from.barycentric.lerp(to.barycentric, t),
                });
            }
            if d_to >= 0.0 {
                kept.push(to);
            }
        }
        kept
    }

    /// A convex polygon has at most one corner more after a cut; rounding may claim otherwise for
    /// slivers, whose surplus corners coincide with others.
    fn push(&mut self, corner: Corner) {
        if self.len < MAX_CORNERS {
            self.corners[self.len] = corner;
            self.len += 1;
        }
    }

    fn piece(&self, normal: DVec3) -> Piece {
        let (mut area, mut centroid) = (0.0, DVec3::ZERO);
        if self.len >= 3 {
            let first = self.corners[0];
            for pair in self.corners[1..self.len].windows(2) {
                let across = (pair[0].position - first.position).cross(pair[1].position - first.position);
                let fan_area = (0.5 * across.dot(normal)).max(0.0);
                area += fan_area;
                centroid += fan_area * (first.barycentric + pair[0].barycentric + pair[1].barycentric) / 3.0;
            }
        }
        if area > 0.0 {
            Piece { area, centroid: centroid / area }
        } else {
            Piece { area: 0.0, centroid: DVec3::splat(1.0 / 3.0) }
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn pieces_add_up_to_the_triangle() {
        let positions = [DVec3::new(0.2, 0.7, 0.1), DVec3::new(3.4, 1.9, 2.6), DVec3::new(1.1, 3.8, 0.9)];
        let triangle = Triangle::new(&positions, [0, 1, 2]).unwrap();
        let (mut area, mut moment) = (0.0, DVec3::ZERO);
        for x in 0..4 {
            for y in 0..4 {
                for z in 0..4 {
                    let piece = clip_to_cell(&triangle, IVec3::new(x, y, z));
                    area += piece.area;
                    moment += piece.area * piece.centroid;
                }
            }
        }
        let whole = 0.5 * (positions[1] - positions[0]).cross(positions[2] - positions[0]).length();
        assert_relative_eq!(area, whole, max_relative = 1e-12);
        assert_relative_eq!((moment / area - DVec3::splat(1.0 / 3.0)).length(), 0.0, epsilon = 1e-12);
    }
}
