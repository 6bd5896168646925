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
    pub sides: Sides,
}

/// From where a triangle is there, by its winding: the front is where its corners go round against the clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    Both,
    Front,
    Back,
}

impl Sides {
    fn include(self, is_front: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Front => is_front,
            Self::Back => !is_front,
        }
    }
}

impl PosedTriangle {
    /// Along its normal.
    pub fn doubled_area(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Is it there for who looks along `direction`, or for light that goes there?
    pub fn is_there_along(&self, direction: DVec3) -> bool {
        self.sides.include(self.doubled_area().dot(direction) < 0.0)
    }

    /// What decides whether a place of it is there: neighbours have one answer on the edge or corner they share.
    pub fn decider(&self, number: usize, place: DVec3) -> u64 {
        let corners = self.corners.iter().zip(place.to_array()).filter(|(_, weight)| *weight > EDGE_SLACK);
        let is_inside = corners.clone().count() == self.corners.len();
        // In any order, so that neighbours who go round the edge another way agree.
        let place = |corner: &DVec3| {
            (corner.x.to_bits() ^ corner.y.to_bits().rotate_left(21)) ^ corner.z.to_bits().rotate_left(42)
        };
        if is_inside { number as u64 } else { corners.fold(0, |sum: u64, (corner, _)| sum.wrapping_add(place(corner))) }
    }

    /// Where a line meets it, from either side: how far along, and the weights of the corners, together 1. Edges belong
    /// to it, so that nothing gets through between neighbours.
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

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];

    fn triangle(corners: [usize; 3], sides: Sides) -> PosedTriangle {
        PosedTriangle { corners: corners.map(|corner| SQUARE[corner]), vertices: [0, 1, 2], surface: 0, sides }
    }

    #[test]
    fn the_front_is_where_corners_go_round_against_the_clock() {
        for (sides, from_front, from_behind) in
            [(Sides::Both, true, true), (Sides::Front, true, false), (Sides::Back, false, true)]
        {
            let triangle = triangle([0, 1, 2], sides);
            for (direction, expected) in [(DVec3::NEG_Z, from_front), (DVec3::Z, from_behind)] {
                assert_eq!(triangle.is_there_along(direction), expected, "{sides:?} {direction}");
            }
        }
    }

    #[test]
    fn neighbours_decide_alike_on_their_edge_and_corners_and_apart_inside() {
        let [a, b] = [triangle([0, 1, 2], Sides::Both), triangle([2, 3, 0], Sides::Both)];
        for share in [0.0, 1e-9, 0.25, 0.5, 1.0] {
            // The corners 0 and 2 are the first and last of one, the third and first of the other.
            let (in_a, in_b) = (DVec3::new(1.0 - share, 0.0, share), DVec3::new(share, 0.0, 1.0 - share));
            assert_eq!(a.decider(0, in_a), b.decider(1, in_b), "{share}");
        }
        let middle = DVec3::splat(1.0 / 3.0);
        assert_ne!(a.decider(0, middle), b.decider(1, middle));
        assert_ne!(a.decider(0, DVec3::new(0.5, 0.5, 0.0)), a.decider(0, DVec3::new(0.5, 0.0, 0.5)));
    }
}
