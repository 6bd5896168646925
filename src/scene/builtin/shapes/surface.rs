//! From a shape to what a file stores: vertices with unit normals, split only where they must be.
//!
//! A corner's normal is the area-weighted mean of the faces around its position that lie within
//! the crease angle of its own face. Degenerate triangles (poles of spheres) are left out.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::Shape;
use crate::scene::builtin::exact::{STEPS, cos};

/// Vertices and triangles ready to be written; all rounded to whole steps.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub uvs: Vec<DVec2>,
    pub triangles: Vec<[u32; 3]>,
}

type Steps3 = [i64; 3];

fn steps3(value: DVec3) -> Steps3 {
    (value * STEPS).round().to_array().map(|step| step as i64)
}

/// A face between distinct positions, with its normal times twice its area.
struct Face {
    corners: [usize; 3],
    places: [Steps3; 3],
    area_normal: DVec3,
}

impl Shape {
    /// Normals are smooth across edges that bend by less than `crease_degrees`.
    pub fn shaded(&self, crease_degrees: f64) -> Surface {
        let faces: Vec<Face> = self.triangles.iter().filter_map(|&corners| self.face(corners)).collect();
        let mut around: HashMap<Steps3, Vec<usize>> = HashMap::new();
        for (index, face) in faces.iter().enumerate() {
            face.places.iter().for_each(|place| around.entry(*place).or_default().push(index));
        }
        let crease_cosine = cos(crease_degrees.to_radians());
        let mut surface = Surface::default();
        let mut known: HashMap<(Steps3, Steps3, [i64; 2]), u32> = HashMap::new();
        for face in &faces {
            let own = face.area_normal.normalize();
            let triangle = std::array::from_fn(|at| {
                let near = around[&face.places[at]].iter().map(|&index| faces[index].area_normal);
                let sum: DVec3 = near.filter(|normal| normal.normalize().dot(own) >= crease_cosine).sum();
                let normal = sum.normalize_or(own);
                let uv = self.uvs[face.corners[at]];
                let uv_steps = (uv * STEPS).round().to_array().map(|step| step as i64);
                *known
                    .entry((face.places[at], steps3(normal), uv_steps))
                    .or_insert_with(|| surface.push(face.places[at], normal, uv))
            });
            surface.triangles.push(triangle);
        }
        surface
    }

    fn face(&self, corners: [usize; 3]) -> Option<Face> {
        let places = corners.map(|corner| steps3(self.positions[corner]));
        let [a, b, c] = places.map(|place| DVec3::from_array(place.map(|step| step as f64 / STEPS)));
        let area_normal = (b - a).cross(c - a);
        // Positions are whole steps, so the cross product of a sliver that is not flat is at least a step squared.
        (area_normal.length() * STEPS * STEPS >= 0.5).then_some(Face { corners, places, area_normal })
    }
}

impl Surface {
    fn push(&mut self, place: Steps3, normal: DVec3, uv: DVec2) -> u32 {
        self.positions.push(DVec3::from_array(place.map(|step| step as f64 / STEPS)));
        self.normals.push(normal);
        self.uvs.push(uv);
        (self.positions.len() - 1) as u32
    }
}
