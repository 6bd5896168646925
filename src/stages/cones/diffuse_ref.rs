//! Reference of `diffuse`: the cones of one pixel, in f64.
//!
//! In: lit nodes, a surface in cells, a pixel's place in its pattern. Out: mean radiance over the
//! cosine-weighted hemisphere with the sky behind, and the open share up to the occlusion distance.

use glam::DVec3;

use super::diffuse::{DiffuseCones, DiffuseTerms};
use crate::settings::Sampling;
use crate::stages::light::gather_ref::{basis, cosine_directions, trace_open};
use crate::stages::sample::sample_points_ref::LitNodes;

/// Where a cone starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Cells from the grid's corner.
    pub position: DVec3,
    /// Unit vectors: as shaded, and of the triangle.
    pub normal: DVec3,
    pub face: DVec3,
}

/// Directions that pixel (x, y) traces: every parts-th of the set of its square of pixels, turned to its
/// normal; what points below the face is mirrored to above it.
pub fn directions(cones: &DiffuseCones, point: &SurfacePoint, [x, y]: [u32; 2]) -> Vec<DVec3> {
    let pattern = cones.pattern_px;
    let part = x % pattern + pattern * (y % pattern);
    let turned = basis(point.normal);
    let all = cosine_directions(cones.directions()).into_iter().map(|direction| turned * direction);
    let own = all.skip(part as usize).step_by((pattern * pattern) as usize);
    own.map(|direction| above_face(direction, point.face)).collect()
}

pub fn above_face(direction: DVec3, face: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(face).min(0.0) * face
}

/// Mean radiance with the sky, and the open share, of a pixel.
pub fn diffuse(
    lit: &LitNodes,
    (cones, sampling, terms): (&DiffuseCones, Sampling, DiffuseTerms),
    sky: DVec3,
    point: &SurfacePoint,
    pixel: [u32; 2],
) -> (DVec3, f64) {
    let apex = point.position + cones.cones.start_cells * point.face;
    let mut sum = (DVec3::ZERO, 0.0);
    for direction in directions(cones, point, pixel) {
        let rules = (&cones.cones, sampling, cones.occlusion_cells);
        let (seen, open) = trace_open(lit, rules, apex, direction);
        sum.0 += if terms.radiance { seen.radiance + sky * seen.through } else { sky * open };
        sum.1 += if terms.occlusion { open } else { 1.0 };
    }
    let count = f64::from(cones.cones.count);
    (sum.0 / count, sum.1 / count)
}
