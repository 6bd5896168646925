//! The part of a triangle inside a cell (Sutherland & Hodgman): its area and its centroid.
//!
//! Points are kept as (s, t) = corner 0 + s · edge 1 + t · edge 2, two numbers where position and
//! barycentric coordinates would be six.

use glam::{DVec2, DVec3, IVec3};

use super::triangle::Triangle;

/// Three corners, and one more for each of six planes.
const MAX_CORNERS: usize = 9;

/// Area in cells² and barycentric centroid of a triangle's part in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub area: f64,
    /// Weights of the triangle's corners; they sum to 1 up to rounding.
    pub centroid: DVec3,
}

/// What all pieces of a triangle share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clipper {
    origin: DVec3,
    edges: [DVec3; 2],
    bounds: [DVec3; 2],
    pub area: f64,
}

impl Clipper {
    pub fn new(triangle: &Triangle) -> Self {
        let [a, b, c] = triangle.corners;
        let area = 0.5 * DVec3::from_array(triangle.projected_areas).length();
        Self { origin: a, edges: [b - a, c - a], bounds: [a.min(b).min(c), a.max(b).max(c)], area }
    }

    /// The part in `cell`. Where rounding leaves no area of it, the area is zero and the centroid
    /// the triangle's own.
    pub fn piece(&self, cell: IVec3) -> Piece {
        let (mut part, mut scratch) = (Polygon::whole(), Polygon::empty());
        let (mut part, mut scratch) = (&mut part, &mut scratch);
        let low = cell.as_dvec3();
        for axis in 0..3 {
            let offset = self.origin[axis] - low[axis];
            let slope = DVec2::new(self.edges[0][axis], self.edges[1][axis]);
            if self.bounds[0][axis] < low[axis] {
                part.cut(scratch, |p| offset + slope.dot(p));
                std::mem::swap(&mut part, &mut scratch);
            }
            if self.bounds[1][axis] > low[axis] + 1.0 {
                part.cut(scratch, |p| 1.0 - offset - slope.dot(p));
                std::mem::swap(&mut part, &mut scratch);
            }
        }
        self.measure(part.corners())
    }

    /// Area and centroid of a convex polygon in (s, t).
    fn measure(&self, corners: &[DVec2]) -> Piece {
        let (mut double_area, mut centroid) = (0.0, DVec2::ZERO);
        if let [first, rest @ ..] = corners {
            for pair in rest.windows(2) {
                // Corners keep their order, so areas are negative by rounding only.
                let fan = (pair[0] - first).perp_dot(pair[1] - first).max(0.0);
                double_area += fan;
                centroid += fan * (first + pair[0] + pair[1]);
            }
        }
        // The whole triangle has the double area 1 in (s, t).
        let area = self.area * double_area;
        let DVec2 { x: s, y: t } = if area > 0.0 { centroid / (3.0 * double_area) } else { DVec2::splat(1.0 / 3.0) };
        Piece { area, centroid: DVec3::new((1.0 - s - t).max(0.0), s, t) }
    }
}

#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec2; MAX_CORNERS],
    len: usize,
}

impl Polygon {
    fn whole() -> Self {
        let mut polygon = Self::empty();
        [DVec2::ZERO, DVec2::X, DVec2::Y].into_iter().for_each(|corner| polygon.push(corner));
        polygon
    }

    fn empty() -> Self {
        Self { corners: [DVec2::ZERO; MAX_CORNERS], len: 0 }
    }

    fn corners(&self) -> &[DVec2] {
        &self.corners[..self.len]
    }

    /// A cut gives a convex polygon at most one corner more; rounding may claim otherwise of
    /// slivers, whose surplus corners coincide with others.
    fn push(&mut self, corner: DVec2) {
        if self.len < MAX_CORNERS {
            self.corners[self.len] = corner;
            self.len += 1;
        }
    }

    /// Leaves in `kept` the part where `distance` is not negative.
    fn cut(&self, kept: &mut Self, distance: impl Fn(DVec2) -> f64) {
        kept.len = 0;
        let Some(&last) = self.corners().last() else { return };
        let mut before = (last, distance(last));
        for &corner in self.corners() {
            let now = (corner, distance(corner));
            if (before.1 < 0.0) != (now.1 < 0.0) {
                kept.push(before.0.lerp(now.0, before.1 / (before.1 - now.1)));
            }
            if now.1 >= 0.0 {
                kept.push(corner);
            }
            before = now;
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
        let clipper = Clipper::new(&Triangle::new(&positions, [0, 1, 2]).unwrap());
        let (mut area, mut moment) = (0.0, DVec3::ZERO);
        for x in 0..4 {
            for y in 0..4 {
                for z in 0..4 {
                    let piece = clipper.piece(IVec3::new(x, y, z));
                    area += piece.area;
                    moment += piece.area * piece.centroid;
                }
            }
        }
        let whole = 0.5 * (positions[1] - positions[0]).cross(positions[2] - positions[0]).length();
        assert_relative_eq!(area, whole, max_relative = 1e-12);
        assert_relative_eq!((moment / area - DVec3::splat(1.0 / 3.0)).length(), 0.0, epsilon = 1e-12);
    }

    #[test]
    fn piece_of_a_large_triangle_is_the_cut_through_the_cell() {
        // The plane x + y + z = 1.5 cuts the unit cell in a regular hexagon with edges of √½.
        let positions = [
            DVec3::new(1.5e4, -0.75e4 + 0.75, -0.75e4 + 0.75),
            DVec3::new(-0.75e4 + 0.75, 1.5e4, -0.75e4 + 0.75),
            DVec3::new(-0.75e4 + 0.75, -0.75e4 + 0.75, 1.5e4),
        ];
        let piece = Clipper::new(&Triangle::new(&positions, [0, 1, 2]).unwrap()).piece(IVec3::ZERO);
        assert_relative_eq!(piece.area, 0.75 * 3f64.sqrt(), max_relative = 1e-9);
        assert_relative_eq!((piece.centroid - DVec3::splat(1.0 / 3.0)).length(), 0.0, epsilon = 1e-9);
    }
}
