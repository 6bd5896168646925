//! Triangles as rays meet them: a compressed wide bounding volume hierarchy finds those that a ray may
//! meet, whose boxes are f32 and wider than rounding needs; triangles themselves are met in f64.
//!
//! In: triangles in cells from the grid's corner, and who decides whether a surface is there. Out: the
//! nearest place that a ray meets, or whether it meets any.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;

use super::triangle::PosedTriangle;

/// Of the largest coordinate: by how much boxes are wider than their triangles. Rounding origin,
/// direction and planes to f32 moves a ray by less than 2^-21 of it.
const BOX_SLACK: f64 = 1.0 / (1 << 19) as f64;

pub struct RayTree {
    triangles: Vec<PosedTriangle>,
    /// `None` where there is no triangle.
    tree: Option<CwBvh>,
    /// Lower and upper corner of the widened boxes.
    bounds: [DVec3; 2],
}

/// From a point along a unit direction for a length, which may be infinite. Cells.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub from: DVec3,
    pub direction: DVec3,
    pub length: f64,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    pub triangle: usize,
    /// Cells along the ray.
    pub distance: f64,
    /// A weight a corner, together 1.
    pub place: DVec3,
}

struct Bounded(Aabb);

impl Boundable for Bounded {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl RayTree {
    pub fn new(triangles: Vec<PosedTriangle>) -> Self {
        let corners = triangles.par_iter().flat_map_iter(|triangle| triangle.corners);
        let largest = corners.map(|corner| corner.abs().max_element()).reduce(|| 0.0, f64::max);
        let slack = DVec3::splat(largest.max(1.0) * BOX_SLACK);
        let widened = |triangle: &PosedTriangle| {
            let [a, b, c] = triangle.corners;
            [a.min(b).min(c) - slack, a.max(b).max(c) + slack]
        };
        let boxes: Vec<[DVec3; 2]> = triangles.par_iter().map(widened).collect();
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = boxes.iter().fold(none, |[min, max], &[low, high]| [min.min(low), max.max(high)]);
        let bounded = |&[min, max]: &[DVec3; 2]| {
            Bounded(Aabb { min: Vec3A::from(min.as_vec3()), max: Vec3A::from(max.as_vec3()) })
        };
        let boxes: Vec<Bounded> = boxes.par_iter().map(bounded).collect();
        let params = BvhBuildParams::medium_build();
        let tree = (!boxes.is_empty()).then(|| build_cwbvh(&boxes, params, &mut Duration::default()));
        Self { triangles, tree, bounds }
    }

    pub fn triangles(&self) -> &[PosedTriangle] {
        &self.triangles
    }

    /// Does a segment meet anything? `is_there` is told triangle and place.
    pub fn meets_any(&self, segment: Segment, is_there: impl Fn(usize, DVec3) -> bool) -> bool {
        let Some(tree) = &self.tree else { return false };
        !tree.ray_traverse_miss(ray(segment), |_, found| {
            let triangle = tree.primitive_indices[found] as usize;
            let is_met = self.triangles[triangle]
                .meets(segment.from, segment.direction)
                .is_some_and(|(t, place)| (0.0..segment.length).contains(&t) && is_there(triangle, place));
            if is_met { 0.0 } else { f32::INFINITY }
        })
    }

    /// The first place that a segment meets. `is_there` is told triangle and place.
    pub fn nearest(&self, segment: Segment, is_there: impl Fn(usize, DVec3) -> bool) -> Option<Met> {
        let tree = self.tree.as_ref()?;
        let skipped = self.enters(segment)?;
        let near = Segment { from: segment.from + segment.direction * skipped, ..segment };
        let near = Segment { length: segment.length - skipped, ..near };
        let mut nearest: Option<Met> = None;
        tree.ray_traverse(ray(near), &mut RayHit::none(), |_, found| {
            let triangle = tree.primitive_indices[found] as usize;
            let met = self.triangles[triangle].meets(near.from, near.direction);
            let end = nearest.map_or(near.length, |met| met.distance);
            match met.filter(|&(t, place)| (0.0..end).contains(&t) && is_there(triangle, place)) {
                Some((distance, place)) => {
                    nearest = Some(Met { triangle, distance, place });
                    rounded_up(distance)
                }
                None => f32::INFINITY,
            }
        });
        nearest.map(|met| Met { distance: met.distance + skipped, ..met })
    }

    /// How far a segment may be skipped before it can meet anything, so that rays from far away lose
    /// nothing in f32; `None` where it misses the whole scene.
    fn enters(&self, segment: Segment) -> Option<f64> {
        let (mut enters, mut leaves) = (0.0_f64, segment.length);
        // Along the others it neither enters nor leaves.
        for axis in (0..3).filter(|&axis| segment.direction[axis] != 0.0) {
            let [a, b] = self.bounds.map(|corner| (corner[axis] - segment.from[axis]) / segment.direction[axis]);
            (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
        }
        (enters <= leaves).then_some(enters)
    }
}

fn ray(segment: Segment) -> Ray {
    // The tree counts −0 as forward and its inverse as backward, and would miss everything: + 0 turns it round.
    let along = segment.direction.as_vec3a() + Vec3A::ZERO;
    Ray::new(segment.from.as_vec3a(), along, 0.0, rounded_up(segment.length))
}

/// The f64 length decides: f32 only prunes.
fn rounded_up(length: f64) -> f32 {
    (length * (1.0 + BOX_SLACK)) as f32
}
