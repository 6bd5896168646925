//! Reference of `direct.wgsl` and `direct_march.wgsl` but for what hides the light: radiance towards the eye
//! from one light at one place, by KHR_lights_punctual.
//!
//! In: a light in cells, a place in cells with its normals and material. Out: nits.

use glam::DVec3;

use super::brdf_ref::Reflector;
use crate::stages::light::illuminate_ref::{Light, Source};
use crate::stages::light::shadow::NEAR_CELLS;

/// A place that the camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub position: DVec3,
    pub normal: DVec3,
    /// The triangle's, on the eye's side.
    pub face: DVec3,
    pub to_eye: DVec3,
    pub reflector: Reflector,
}

/// Without anything that hides the light.
pub fn radiance(light: &Light, place: &Place) -> DVec3 {
    let (to_light, irradiance) = arrival(light, place.position);
    let cosine = place.normal.dot(to_light);
    if cosine <= 0.0 || place.face.dot(to_light) <= 0.0 {
        return DVec3::ZERO;
    }
    place.reflector.brdf(place.normal, to_light, place.to_eye) * cosine * irradiance
}

/// Unit direction to the light, and irradiance on a plane across it, lux.
fn arrival(light: &Light, p: DVec3) -> (DVec3, DVec3) {
    let (position, range) = match light.source {
        Source::Sun(direction) => return (-direction, light.strength),
        Source::Point(position, range) | Source::Spot(position, _, _, range) => (position, range),
    };
    let distance = position.distance(p).max(NEAR_CELLS);
    let to_light = (position - p) / distance;
    let window = range.map_or(1.0, |range| (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0));
    let inside = match light.source {
        Source::Spot(_, direction, [inner, outer], _) => {
            ((direction.dot(-to_light) - outer) / (inner - outer).max(0.001)).clamp(0.0, 1.0).powi(2)
        }
        Source::Sun(_) | Source::Point(..) => 1.0,
    };
    (to_light, light.strength * (window * inside / distance.powi(2)))
}
