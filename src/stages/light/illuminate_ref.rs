//! Reference of `illuminate.wgsl`: irradiance of one light at one leaf, from KHR_lights_punctual.
//!
//! In: a light in cells, a leaf's centre and mean normal n̄, the share of the light that gets through.
//! A mean normal of length r stands for a share r of surface that faces along it, and a rest 1 − r that
//! faces every way: cos = r·max(n̂·l, 0) + (1 − r)/4. Out: lux.

use glam::{DVec3, IVec3};

use super::{LEAST_DISTANCE_CELLS, SPREAD_COSINE};
use crate::stages::pixels::crossings::crossings;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// The way it shines.
    Sun(DVec3),
    /// Position, and where it ends.
    Point(DVec3, Option<f64>),
    /// Position, direction, cosines of the inner and outer cone, and where it ends.
    Spot(DVec3, DVec3, [f64; 2], Option<f64>),
}

/// Strength: lux, or candela over the squared span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    pub source: Source,
    pub strength: DVec3,
}

/// Where light comes from: unit direction to it, and distance in cells.
pub fn towards(source: Source, p: DVec3) -> (DVec3, f64) {
    match source {
        Source::Sun(direction) => (-direction, f64::INFINITY),
        Source::Point(position, _) | Source::Spot(position, ..) => {
            let distance = (position - p).length().max(LEAST_DISTANCE_CELLS);
            ((position - p) / distance, distance)
        }
    }
}

pub fn irradiance(light: &Light, centre: DVec3, mean_normal: DVec3, visibility: f64) -> DVec3 {
    let (to_light, distance) = towards(light.source, centre);
    let within = |range: Option<f64>| range.map_or(1.0, |range| (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0));
    let falloff = match light.source {
        Source::Sun(_) => 1.0,
        Source::Point(_, range) => within(range) / distance.powi(2),
        Source::Spot(_, direction, [inner, outer], range) => {
            let cosine = direction.dot(-to_light);
            let inside = ((cosine - outer) / (inner - outer).max(0.001)).clamp(0.0, 1.0);
            within(range) / distance.powi(2) * inside.powi(2)
        }
    };
    let r = mean_normal.length().min(1.0);
    let cosine = r * mean_normal.normalize_or_zero().dot(to_light).max(0.0) + (1.0 - r) * SPREAD_COSINE;
    light.strength * (falloff * cosine * visibility)
}

/// What leaves of opacity α let through over a path: ∏ (1 − α)^s over the lengths s inside them, from
/// `origin` for `length` cells.
pub fn transmittance(
    origin: DVec3,
    direction: DVec3,
    length: f64,
    cells: u32,
    alpha: impl Fn(IVec3) -> Option<f64>,
) -> f64 {
    let inside = crossings(origin, direction, cells).into_iter().filter(|crossing| crossing.from < length);
    inside
        .filter_map(|crossing| Some((1.0 - alpha(crossing.cell)?).powf(crossing.to.min(length) - crossing.from)))
        .product()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn a_candela_at_two_cells_is_a_quarter_and_a_slanted_sun_its_cosine() {
        let point = Light { source: Source::Point(DVec3::new(0.0, 2.0, 0.0), None), strength: DVec3::ONE };
        assert!((irradiance(&point, DVec3::ZERO, DVec3::Y, 1.0).x - 0.25).abs() < 1e-15);
        assert_eq!(irradiance(&point, DVec3::ZERO, DVec3::NEG_Y, 1.0), DVec3::ZERO);
        let slanted = DVec3::new((PI / 3.0).sin(), -(PI / 3.0).cos(), 0.0);
        let sun = Light { source: Source::Sun(slanted), strength: DVec3::splat(10.0) };
        assert!((irradiance(&sun, DVec3::ZERO, DVec3::Y, 0.5).y - 2.5).abs() < 1e-12);
    }

    #[test]
    fn cancelled_normals_see_a_quarter_from_anywhere() {
        for direction in [DVec3::X, DVec3::NEG_Y, DVec3::ONE.normalize()] {
            let sun = Light { source: Source::Sun(direction), strength: DVec3::ONE };
            assert_eq!(irradiance(&sun, DVec3::ZERO, DVec3::ZERO, 1.0), DVec3::splat(0.25));
        }
    }

    #[test]
    fn a_half_opaque_cell_halves_over_its_length() {
        let half = |cell: IVec3| (cell == IVec3::new(2, 1, 1)).then_some(0.5);
        let through = transmittance(DVec3::new(0.5, 1.5, 1.5), DVec3::X, f64::INFINITY, 4, half);
        assert!((through - 0.5).abs() < 1e-12);
        let up_to = transmittance(DVec3::new(0.5, 1.5, 1.5), DVec3::X, 2.0, 4, half);
        assert!((up_to - 0.5_f64.sqrt()).abs() < 1e-12);
    }
}
