//! Reference of `diffuse`: the cones of one pixel, in f64.
//!
//! In: lit nodes, a surface in cells, a pixel's place in its pattern. Out: mean radiance over the
//! cosine-weighted hemisphere with the sky behind, and the open share up to the occlusion distance.

use glam::DVec3;

use super::diffuse::{DiffuseCones, DiffuseTerms};
use crate::settings::Sampling;
use crate::stages::light::gather_ref::{TraceRules, basis, cosine_directions, trace_open};
use crate::stages::sample::sample_points_ref::{Horizon, LitNodes};

/// Where a cone starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Cells from the grid's corner.
    pub position: DVec3,
    /// Unit vectors: as shaded, and of the triangle.
    pub normal: DVec3,
    pub face: DVec3,
}

impl SurfacePoint {
    /// What its cones do not see.
    pub fn horizon(&self) -> Horizon {
        Horizon { position: self.position, face: self.face }
    }
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
    let rules = TraceRules {
        cones: &cones.cones,
        sampling,
        occlusion_cells: cones.occlusion_cells,
        horizon: Some(point.horizon()),
    };
    for direction in directions(cones, point, pixel) {
        let (seen, open) = trace_open(lit, &rules, apex, direction);
        sum.0 += if terms.radiance { seen.radiance + sky * seen.through } else { sky * open };
        sum.1 += if terms.occlusion { open } else { 1.0 };
    }
    let count = f64::from(cones.cones.count);
    (sum.0 / count, sum.1 / count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::ConeTracing;

    #[test]
    fn the_pixels_of_a_pattern_share_one_set_of_directions() {
        // Tilted normals, so that some directions are mirrored at the face.
        let face = DVec3::new(0.2, -0.4, 0.9).normalize();
        let point = SurfacePoint { position: DVec3::ONE, normal: DVec3::new(0.5, 0.1, 0.8).normalize(), face };
        for pattern_px in ConeTracing::PATTERNS_PX {
            let settings = ConeTracing { pattern_px, cones: 3, ..ConeTracing::default() };
            let cones = DiffuseCones::new(&settings, 64, 0.1);
            let pixels = (0..pattern_px).flat_map(|y| (0..pattern_px).map(move |x| [x + 8, y + 4]));
            let all: Vec<_> = pixels.flat_map(|pixel| directions(&cones, &point, pixel)).collect();
            assert_eq!(all.len(), cones.directions() as usize);
            let weight = 1.0 / f64::from(cones.cones.count) / f64::from(pattern_px * pattern_px);
            assert!((all.len() as f64 * weight - 1.0).abs() < 1e-12);
            let is_distinct = |a: usize| (0..a).all(|b| all[a].distance(all[b]) > 1e-3);
            assert!((0..all.len()).all(is_distinct) && all.iter().all(|d| d.dot(face) >= 0.0), "{pattern_px}");
        }
    }
}
