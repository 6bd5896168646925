//! A triangle in cells, in an order that does not depend on how the file lists it.

use std::cmp::Ordering;

use glam::DVec3;

/// Corners sorted by position, so that winding and index order change nothing downstream.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub corners: [DVec3; 3],
    /// The corners' indices.
    pub vertices: [u32; 3],
    /// Twice the signed areas of the projections along x, y and z: the face normal, unnormalised.
    /// Signs, zeros included, are exact.
    pub projected_areas: [f64; 3],
}

impl Triangle {
    /// `None` for a triangle without area: collinear corners or a repeated one. Indices must be in range.
    pub fn new(positions: &[DVec3], indices: [u32; 3]) -> Option<Self> {
        // Adding zero turns -0 into 0.
        let mut sorted = indices.map(|index| (positions[index as usize] + DVec3::ZERO, index));
        sorted.sort_unstable_by(|a, b| by_position(a.0, b.0));
        let corners = sorted.map(|(position, _)| position);
        let projected_areas = [0, 1, 2].map(|axis| {
            let [a, b, c] = corners.map(|corner| {
                let p = corner.to_array();
                robust::Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] }
            });
            robust::orient2d(a, b, c)
        });
        let flat = projected_areas.iter().all(|&area| area == 0.0);
        (!flat).then_some(Self { corners, vertices: sorted.map(|(_, index)| index), projected_areas })
    }

    /// The axis along which the face looks largest; of equals z before y before x.
    pub fn dominant_axis(&self) -> usize {
        let [x, y, z] = self.projected_areas.map(f64::abs);
        if z >= x && z >= y {
            2
        } else if y >= x {
            1
        } else {
            0
        }
    }
}

fn by_position(a: DVec3, b: DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_of_corners_does_not_matter() {
        let positions = [DVec3::new(0.3, -1.0, 2.0), DVec3::new(4.0, 0.1, 0.7), DVec3::new(0.3, 5.0, -2.2)];
        let first = Triangle::new(&positions, [0, 1, 2]).unwrap();
        for order in [[1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            let other = Triangle::new(&positions, order).unwrap();
            assert_eq!(other.vertices, first.vertices);
            assert_eq!(other.projected_areas, first.projected_areas);
        }
    }

    #[test]
    fn collinear_is_decided_exactly() {
        let (a, b) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.7, 0.9, 1.3));
        assert!(Triangle::new(&[a, a, b], [0, 1, 2]).is_none());
        let line = [DVec3::ZERO, DVec3::splat(1.0), DVec3::splat(3.0)];
        assert!(Triangle::new(&line, [0, 1, 2]).is_none());
        let bent = [DVec3::ZERO, DVec3::splat(1.0), DVec3::new(3.0, 3.0, 3.0 + f64::EPSILON * 2.0)];
        assert!(Triangle::new(&bent, [0, 1, 2]).is_some());
    }
}
