//! Solids with flat faces, and the spheres made from them. All are centred on the origin.

use glam::{DVec2, DVec3};

use super::Shape;
use crate::scene::builtin::exact::{PI, TAU, cos, sin};

/// A box of the given size.
pub fn block(x: f64, y: f64, z: f64) -> Shape {
    let half = DVec3::new(x, y, z) / 2.0;
    let mut faces = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[first, second]| {
                let mut corner = DVec3::ZERO;
                corner[axis] = sign;
                corner[(axis + 1) % 3] = first * sign;
                corner[(axis + 2) % 3] = second;
                corner * half
            });
            faces.push(Shape::polygon(&corners));
        }
    }
    Shape::joined(faces).box_mapped(1.0)
}

/// A box whose edges and corners are cut back by `bevel`.
pub fn bevelled_block(x: f64, y: f64, z: f64, bevel: f64) -> Shape {
    let half = DVec3::new(x, y, z) / 2.0;
    let corner = |signs: [f64; 3], axis: usize| {
        let mut position = DVec3::from_array(signs) * (half - bevel);
        position[axis] = signs[axis] * half[axis];
        position
    };
    let signs = [-1.0, 1.0];
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let signed = |a: f64, b: f64, c: f64| {
            let mut all = [0.0; 3];
            (all[axis], all[next], all[last]) = (a, b, c);
            all
        };
        for a in signs {
            let face = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            faces.push(face.map(|(b, c)| corner(signed(a, b, c), axis)).to_vec());
            for b in signs {
                let ends = [(-1.0, axis), (1.0, axis), (1.0, next), (-1.0, next)];
                faces.push(ends.map(|(c, at)| corner(signed(a, b, c), at)).to_vec());
            }
        }
    }
    for x in signs {
        for y in signs {
            for z in signs {
                faces.push((0..3).map(|axis| corner([x, y, z], axis)).collect());
            }
        }
    }
    Shape::joined(faces.iter().map(|corners| facing_away(Shape::polygon(corners)))).box_mapped(1.0)
}

/// Turns a face of a convex body around the origin to the outside.
fn facing_away(face: Shape) -> Shape {
    let [a, b, c] = face.triangles[0].map(|corner| face.positions[corner]);
    if (b - a).cross(c - a).dot(a) < 0.0 { face.flipped() } else { face }
}

/// An icosahedron of unit radius whose faces were split in four `levels` times.
pub fn icosphere(levels: usize) -> Shape {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut corners = Vec::new();
    for (a, b) in [(-1.0, -golden), (1.0, -golden), (-1.0, golden), (1.0, golden)] {
        corners.extend([DVec3::new(a, b, 0.0), DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a)]);
    }
    let mut faces = Vec::new();
    let close = |a: usize, b: usize| (corners[a] - corners[b]).length_squared() < 4.1;
    for a in 0..12 {
        for b in a + 1..12 {
            faces.extend((b + 1..12).filter(|&c| close(a, b) && close(b, c) && close(c, a)).map(|c| [a, b, c]));
        }
    }
    let mut triangles: Vec<[DVec3; 3]> =
        faces.iter().map(|face| face.map(|corner| corners[corner].normalize())).collect();
    for _ in 0..levels {
        triangles = triangles.iter().flat_map(split_in_four).collect();
    }
    Shape::joined(triangles.iter().map(|corners| facing_away(Shape::polygon(corners)))).box_mapped(1.0)
}

fn split_in_four(&[a, b, c]: &[DVec3; 3]) -> [[DVec3; 3]; 4] {
    let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
    [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
}

/// A sphere of unit radius with its poles on Y.
pub fn sphere(segments: usize, rings: usize) -> Shape {
    Shape::grid(segments, rings, |u, v| {
        let (around, up) = (u * TAU, (v - 0.5) * PI);
        (DVec3::new(cos(around) * cos(up), sin(up), -sin(around) * cos(up)), DVec2::new(u * 2.0, 1.0 - v))
    })
}
