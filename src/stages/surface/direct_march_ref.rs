//! Reference of `direct_march.wgsl`: the share of a light that leaves let through to a place.

use glam::IVec3;

use super::direct_ref::Place;
use crate::stages::light::illuminate_ref::{Source, transmittance};

/// `offset_cells`: above the triangle, where the shadow ray starts. `alpha`: of an occupied leaf.
pub fn visibility(
    place: &Place,
    source: Source,
    offset_cells: f64,
    cells: u32,
    alpha: impl Fn(IVec3) -> Option<f64>,
) -> f64 {
    let start = place.position + offset_cells * place.face;
    let (direction, length) = match source {
        Source::Sun(direction) => (-direction, f64::INFINITY),
        Source::Point(position, _) | Source::Spot(position, ..) => {
            ((position - start).normalize(), position.distance(start))
        }
    };
    transmittance(start, direction, length, cells, alpha)
}
