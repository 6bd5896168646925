//! How far blended joints take the voxels of a skin from where they should be, however each is moved.
//!
//! In: blended matrices at the corners of a triangle, A and B, in scene units. A voxel half-way between corners a and b
//! has their mean weights and is moved to (A + B)/2 · (a + b)/2; the posed triangle has (A·a + B·b)/2 there, which is
//! ¼·|(A − B)·(a − b)| away. And where a triangle is σ times as long as the one that voxels were made from, each voxel
//! should reach σ/2 from its centre, and split ones reach 1. Out: the larger of both in cells, on all but a small share
//! of the surface.

use std::array;

use glam::{DMat3, DMat4, DVec3};
use rayon::prelude::*;

use super::{Motion, Object, Pose, Scene};

/// What may stretch more than is told: this share of an object's surface, and in any case a cell's. Few of its cells are
/// holes where it is moved.
const SHARE_LEFT_OUT: f64 = 1.0 / 256.0;

/// Triangles that are posed at most, over all objects and moments. Where there are more, fewer moments are looked at.
const MOST_POSED_TRIANGLES: usize = 1 << 24;

/// Moments of a clip that can be looked at in all objects.
pub(super) fn affordable_moments(scene: &Scene, objects: &[Object]) -> usize {
    let triangles: usize = skinned(objects).map(|(_, object)| scene.meshes[object.mesh].triangle_count()).sum();
    MOST_POSED_TRIANGLES / triangles.max(1)
}

/// Those that may be strained.
fn skinned(objects: &[Object]) -> impl Iterator<Item = (usize, &Object)> {
    objects.iter().enumerate().filter(|(_, object)| matches!(object.motion, Motion::Skinned { .. }))
}

/// The strain of all skinned objects, over the poses looked at.
pub(super) struct Strains<'a> {
    /// Index, and what is known of it.
    objects: Vec<(usize, Strain<'a>)>,
    span: f64,
}

struct Strain<'a> {
    object: &'a Object,
    parts: Vec<Baked>,
    area: f64,
    /// Cells.
    largest: f64,
}

/// A primitive as its voxels were made.
struct Baked {
    primitive: usize,
    triangles: Vec<BakedTriangle>,
}

struct BakedTriangle {
    vertices: [usize; 3],
    /// Of the mesh, before anything is baked.
    corners: [DVec3; 3],
    area: f64,
    metric: Metric,
}

/// The lengths of two edges of a triangle and the angle between them: a·a, a·b, b·b.
#[derive(Clone, Copy)]
struct Metric([f64; 3]);

impl<'a> Strains<'a> {
    pub fn new(scene: &Scene, objects: &'a [Object], span: f64) -> Self {
        let objects: Vec<(usize, &Object)> = skinned(objects).collect();
        let objects = objects.into_par_iter().map(|(index, object)| (index, Strain::new(scene, object)));
        Self { objects: objects.collect(), span }
    }

    pub fn is_empty(&self) -> bool {
        self.objects.is_empty()
    }

    pub fn look_at(&mut self, scene: &Scene, pose: &Pose) {
        let span = self.span;
        self.objects.par_iter_mut().for_each(|(_, strain)| strain.look_at(scene, pose, span));
    }

    /// Index of the object, and cells.
    pub fn found(self) -> impl Iterator<Item = (usize, f64)> {
        self.objects.into_iter().map(|(index, strain)| (index, strain.largest))
    }
}

impl<'a> Strain<'a> {
    fn new(scene: &Scene, object: &'a Object) -> Self {
        let primitives = scene.meshes[object.mesh].primitives.iter().enumerate();
        let parts = primitives.filter(|(_, primitive)| !primitive.joints.is_empty()).map(|(index, primitive)| {
            let corner = |vertex: u32| primitive.positions[vertex as usize].as_dvec3();
            let triangles = primitive.triangles.iter().filter_map(|vertices| {
                BakedTriangle::new(vertices.map(|vertex| vertex as usize), vertices.map(corner), &object.stretch)
            });
            Baked { primitive: index, triangles: triangles.collect() }
        });
        let parts: Vec<Baked> = parts.collect();
        let area = parts.iter().flat_map(|part| &part.triangles).map(|triangle| triangle.area).sum();
        Self { object, parts, area, largest: 0.0 }
    }

    fn look_at(&mut self, scene: &Scene, pose: &Pose, span: f64) {
        let mut longer: Vec<(f64, f64)> = Vec::new();
        for part in &self.parts {
            let matrices = scene.blended_matrices(self.object, part.primitive, pose);
            let strained = part.triangles.iter().map(|triangle| (triangle.cells(&matrices, span), triangle.area));
            longer.extend(strained.filter(|(cells, _)| *cells > self.largest));
        }
        longer.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut left_out = (SHARE_LEFT_OUT * self.area).max(span * span);
        let told = longer.into_iter().find(|(_, area)| {
            left_out -= area;
            left_out < 0.0
        });
        self.largest = told.map_or(self.largest, |(cells, _)| cells);
    }
}

impl BakedTriangle {
    /// `None` for one without an area.
    fn new(vertices: [usize; 3], corners: [DVec3; 3], stretch: &DMat3) -> Option<Self> {
        let baked = corners.map(|corner| *stretch * corner);
        let [a, b] = [baked[1] - baked[0], baked[2] - baked[0]];
        let (metric, area) = (Metric::of(a, b), 0.5 * a.cross(b).length());
        (metric.determinant() > 0.0 && area > 0.0).then_some(Self { vertices, corners, area, metric })
    }

    /// Zero where it is at no finite place.
    fn cells(&self, matrices: &[DMat4], span: f64) -> f64 {
        let moved = self.vertices.map(|vertex| matrices[vertex]);
        let posed: [DVec3; 3] = array::from_fn(|corner| moved[corner].transform_point3(self.corners[corner]));
        let ratio = Metric::of(posed[1] - posed[0], posed[2] - posed[0]).largest_ratio(&self.metric);
        let off = |[i, j]: [usize; 2]| {
            let edge = self.corners[i] - self.corners[j];
            (moved[i].transform_vector3(edge) - moved[j].transform_vector3(edge)).length() / 4.0
        };
        [[0, 1], [1, 2], [2, 0]].into_iter().map(|edge| off(edge) / span).fold((ratio / 2.0 - 1.0).max(0.0), f64::max)
    }
}

impl Metric {
    fn of(a: DVec3, b: DVec3) -> Self {
        Self([a.length_squared(), a.dot(b), b.length_squared()])
    }

    fn determinant(&self) -> f64 {
        let [aa, ab, bb] = self.0;
        aa * bb - ab * ab
    }

    /// The largest length over that of another, along any direction: the root of the larger eigenvalue of before⁻¹ · self.
    fn largest_ratio(&self, before: &Self) -> f64 {
        let ([aa, ab, bb], [cc, cd, dd]) = (self.0, before.0);
        let trace = (aa * dd - 2.0 * ab * cd + bb * cc) / before.determinant();
        let product = self.determinant() / before.determinant();
        (trace / 2.0 + (trace * trace / 4.0 - product).max(0.0).sqrt()).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(1.0, 3.0, 0.0)];

    fn triangle(stretch: DMat3) -> BakedTriangle {
        BakedTriangle::new([0, 1, 2], CORNERS, &stretch).expect("it has an area")
    }

    #[test]
    fn split_voxels_reach_as_far_as_those_of_a_triangle_twice_as_long_and_turns_do_not_count() {
        let turn = DMat4::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.9);
        for (stretch, cells) in [(DVec3::ONE, 0.0), (DVec3::new(3.0, 1.0, 1.0), 0.5), (DVec3::new(0.5, 0.2, 9.0), 0.0)]
        {
            let moved = [turn * DMat4::from_scale(stretch); 3];
            assert!((triangle(DMat3::IDENTITY).cells(&moved, 1e-3) - cells).abs() < 1e-6, "{stretch}");
            // What is baked is there already.
            assert!(triangle(DMat3::from_diagonal(stretch)).cells(&moved, 1e-3) < 1e-6, "{stretch}");
        }
        assert!(BakedTriangle::new([0, 1, 2], [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], &DMat3::IDENTITY).is_none());
    }

    /// A corner turned by a quarter about its own place: no corner moves, and the middle of an edge of length 4 has
    /// voxels ¼·√2·4 away.
    #[test]
    fn voxels_between_corners_that_turn_apart_leave_the_triangle() {
        let moved = [DMat4::from_rotation_x(0.0), DMat4::IDENTITY, DMat4::IDENTITY];
        assert_eq!(triangle(DMat3::IDENTITY).cells(&moved, 1.0), 0.0);
        let turned = [DMat4::from_rotation_y(FRAC_PI_2), DMat4::IDENTITY, DMat4::IDENTITY];
        let triangle =
            BakedTriangle::new([0, 1, 2], [CORNERS[0], CORNERS[1], DVec3::Y], &DMat3::IDENTITY).expect("area");
        assert!((triangle.cells(&turned, 0.5) - 2.0 * 2.0_f64.sqrt()).abs() < 1e-12);
    }
}
