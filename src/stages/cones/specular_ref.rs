//! Reference of `specular`: the reflection cone of one surface, in f64.

use glam::DVec3;

use super::diffuse_ref::{SurfacePoint, above_face};
use super::specular::aperture_degrees;
use crate::settings::Sampling;
use crate::stages::light::gather::Cones;
use crate::stages::light::gather_ref::{TraceRules, trace_open};
use crate::stages::sample::sample_points_ref::LitNodes;

/// Radiance along the mirrored direction, `cones` with the aperture of the roughness, `from_eye` a unit vector.
pub fn specular(
    lit: &LitNodes,
    (cones, sampling): (&Cones, Sampling),
    sky: DVec3,
    (point, from_eye, roughness): (&SurfacePoint, DVec3, f64),
) -> DVec3 {
    let cones = Cones { aperture_degrees: aperture_degrees(roughness), ..*cones };
    let mirrored = from_eye - 2.0 * from_eye.dot(point.normal) * point.normal;
    let apex = point.position + cones.start_cells * point.face;
    let rules = TraceRules { cones: &cones, sampling, occlusion_cells: 0.0, horizon: Some(point.horizon()) };
    let (seen, _) = trace_open(lit, &rules, apex, above_face(mirrored, point.face));
    seen.radiance + sky * seen.through
}
