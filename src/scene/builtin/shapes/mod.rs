//! Shapes: triangles with texture coordinates, from boxes to cloth, and how they get normals.
//!
//! Builders make a [`Shape`] (positions in metres, counter-clockwise triangles, UVs). It is
//! moved, bent and joined freely; [`Shape::shaded`] then computes smooth normals up to a crease
//! angle and gives the [`Surface`] that a file stores. Seams need no care: vertices meet by
//! position.

pub mod architecture;
pub mod round;
pub mod solid;
pub mod surface;

use glam::{DVec2, DVec3};

use super::exact::turn;
pub use surface::Surface;

#[derive(Clone, Debug, Default)]
pub struct Shape {
    pub positions: Vec<DVec3>,
    pub uvs: Vec<DVec2>,
    pub triangles: Vec<[usize; 3]>,
}

impl Shape {
    /// A sheet of `columns` x `rows` cells; `point` maps `u, v` in 0 to 1 to a position and a
    /// UV. The front is where ∂u × ∂v points.
    pub fn grid(columns: usize, rows: usize, point: impl Fn(f64, f64) -> (DVec3, DVec2)) -> Self {
        let mut shape = Self::default();
        for row in 0..=rows {
            for column in 0..=columns {
                let (position, uv) = point(column as f64 / columns as f64, row as f64 / rows as f64);
                shape.positions.push(position);
                shape.uvs.push(uv);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let near = row * (columns + 1) + column;
                let far = near + columns + 1;
                shape.triangles.extend([[near, near + 1, far + 1], [near, far + 1, far]]);
            }
        }
        shape
    }

    /// Each triangle as four, cut through the middles of its edges.
    pub fn split_in_four(&self) -> Self {
        let mut split = Self::default();
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| (self.positions[corner], self.uvs[corner]));
            let middle = |p: (DVec3, DVec2), q: (DVec3, DVec2)| ((p.0 + q.0) / 2.0, (p.1 + q.1) / 2.0);
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            for triangle in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
                let first = split.positions.len();
                split.positions.extend(triangle.map(|(position, _)| position));
                split.uvs.extend(triangle.map(|(_, uv)| uv));
                split.triangles.push([first, first + 1, first + 2]);
            }
        }
        split
    }

    /// A flat convex polygon, counter-clockwise seen from its front.
    pub fn polygon(corners: &[DVec3]) -> Self {
        Self {
            positions: corners.to_vec(),
            uvs: vec![DVec2::ZERO; corners.len()],
            triangles: (2..corners.len()).map(|last| [0, last - 1, last]).collect(),
        }
    }

    pub fn joined(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut whole = Self::default();
        for part in parts {
            let first = whole.positions.len();
            whole.positions.extend(part.positions);
            whole.uvs.extend(part.uvs);
            whole.triangles.extend(part.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
        }
        whole
    }

    /// Moves every vertex; the caller keeps the orientation.
    pub fn mapped(mut self, place: impl Fn(DVec3) -> DVec3) -> Self {
        self.positions.iter_mut().for_each(|position| *position = place(*position));
        self
    }

    pub fn moved(self, x: f64, y: f64, z: f64) -> Self {
        self.mapped(|position| position + DVec3::new(x, y, z))
    }

    pub fn turned(self, axis: DVec3, radians: f64) -> Self {
        let rotation = turn(axis, radians);
        self.mapped(|position| rotation * position)
    }

    /// Scales about the origin; a mirroring scale keeps the front in front.
    pub fn scaled(self, x: f64, y: f64, z: f64) -> Self {
        let factors = DVec3::new(x, y, z);
        let scaled = self.mapped(|position| position * factors);
        if x * y * z < 0.0 { scaled.flipped() } else { scaled }
    }

    /// Swaps front and back.
    pub fn flipped(mut self) -> Self {
        self.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        self
    }

    /// Turns a closed shape the right side out.
    pub fn outward(self) -> Self {
        let corner = |index: usize| self.positions[index];
        let volume: f64 = self.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum();
        if volume < 0.0 { self.flipped() } else { self }
    }

    /// Replaces the UVs by positions along the two axes a face lies in, one repeat every
    /// `repeat_m` metres.
    pub fn box_mapped(self, repeat_m: f64) -> Self {
        let mut split = Self::default();
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| self.positions[corner]);
            let facing = (b - a).cross(c - a).abs();
            let first = split.positions.len();
            for position in [a, b, c] {
                let uv = if facing.y >= facing.x && facing.y >= facing.z {
                    DVec2::new(position.x, position.z)
                } else if facing.x >= facing.z {
                    DVec2::new(position.z, -position.y)
                } else {
                    DVec2::new(position.x, -position.y)
                };
                split.positions.push(position);
                split.uvs.push(uv / repeat_m);
            }
            split.triangles.push([first, first + 1, first + 2]);
        }
        split
    }
}

#[cfg(test)]
mod tests {
    use super::round::{cylinder, lathe, torus};
    use super::solid::{bevelled_block, block, icosphere, sphere};
    use super::*;
    use crate::scene::builtin::exact::PI;

    fn volume(shape: &Shape) -> f64 {
        let at = |index: usize| shape.positions[index];
        shape.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum()
    }

    #[test]
    fn closed_shapes_enclose_their_volume() {
        assert!((volume(&block(1.0, 2.0, 3.0)) - 6.0).abs() < 1e-12);
        // A bevel takes half its square along each of the twelve edges, and more at the corners.
        let bevelled = 1.0 - volume(&bevelled_block(1.0, 1.0, 1.0, 0.1));
        assert!((12.0 * 0.005 * 0.8..12.0 * 0.005).contains(&bevelled), "{bevelled}");
        // Inscribed polyhedra fill a little less than the round body.
        for (shape, round) in [
            (icosphere(3), 4.0 / 3.0 * PI),
            (sphere(64, 32), 4.0 / 3.0 * PI),
            (cylinder(1.0, 1.0, 64), PI),
            (torus(2.0, 0.5, 64, 64), 2.0 * PI * PI * 2.0 * 0.25),
        ] {
            assert!((0.98 * round..round).contains(&volume(&shape)), "{} of {round}", volume(&shape));
        }
    }

    #[test]
    fn splitting_changes_no_surface() {
        let ball = icosphere(1);
        let split = ball.split_in_four();
        assert_eq!(split.triangles.len(), 4 * ball.triangles.len());
        assert!((volume(&split) - volume(&ball)).abs() < 1e-12);
    }

    #[test]
    fn mirroring_keeps_the_right_side_out() {
        let cone = lathe(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 16);
        assert!((volume(&cone.clone().scaled(-1.0, 1.0, 1.0)) - volume(&cone)).abs() < 1e-12);
        assert!((volume(&cone.clone().flipped().outward()) - volume(&cone)).abs() < 1e-12);
    }

    #[test]
    fn creases_split_vertices_and_seams_do_not() {
        let cube = block(1.0, 1.0, 1.0);
        let flat = Shape { uvs: vec![DVec2::ZERO; cube.uvs.len()], ..cube };
        assert_eq!(flat.shaded(30.0).positions.len(), 24);
        assert_eq!(flat.shaded(100.0).positions.len(), 8);
        let ball = sphere(16, 8);
        for (position, normal) in ball.shaded(60.0).positions.iter().zip(ball.shaded(60.0).normals) {
            assert!(position.normalize().dot(normal) > 0.99);
        }
    }
}
