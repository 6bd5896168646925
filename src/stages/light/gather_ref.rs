//! Reference of `gather`: cones through a map of lit nodes (section 4.5), in f64.
//!
//! In: nodes, a leaf's centre and mean normal, the cones. Out: the mean radiance over the cosine-weighted
//! hemisphere, and the share of the sky that is seen; irradiance is π times the first, and π times the
//! second times the sky's radiance. A cone ends at its reach or the grid's edge, never early.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::gather::Cones;
use crate::settings::Sampling;
use crate::stages::pixels::SHORT_NORMAL;
use crate::stages::sample::sample_points_ref::{Horizon, LitNodes};

/// Means over cones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ConeLight {
    pub radiance: DVec3,
    pub through: f64,
}

/// `count` distinct unit vectors around +z, of equal weight 1/`count` under the cosine: points of equal
/// area on the unit disc, each turned by the golden angle, lifted to the hemisphere.
pub fn cosine_directions(count: u32) -> Vec<DVec3> {
    let golden_ratio = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let direction = |i: u32| {
        let radius = ((f64::from(i) + 0.5) / f64::from(count)).sqrt();
        // Backwards by 1/φ is forwards by 1/φ².
        let (sin, cos) = (-f64::from(i) * TAU / golden_ratio).sin_cos();
        DVec3::new(radius * cos, radius * sin, (1.0 - radius * radius).sqrt())
    };
    (0..count).map(direction).collect()
}

/// Orthonormal, with `n` as third column (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
pub fn basis(n: DVec3) -> DMat3 {
    let sign = 1.0_f64.copysign(n.z);
    let (a, b) = (-1.0 / (sign + n.z), -n.x * n.y / (sign + n.z));
    let x = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    let y = DVec3::new(b, sign + n.y * n.y * a, -n.y);
    DMat3::from_cols(x, y, n)
}

/// One cone from its apex.
pub fn trace(lit: &LitNodes, cones: &Cones, apex: DVec3, direction: DVec3) -> ConeLight {
    let rules = TraceRules { cones, sampling: Sampling::Quadrilinear, occlusion_cells: 0.0, horizon: None };
    trace_open(lit, &rules, apex, direction).0
}

/// How a cone is traced.
#[derive(Clone, Copy, Debug)]
pub struct TraceRules<'a> {
    pub cones: &'a Cones,
    pub sampling: Sampling,
    /// What is farther away leaves a cone open.
    pub occlusion_cells: f64,
    /// Of the surface that it starts at.
    pub horizon: Option<Horizon>,
}

/// One cone by these rules, and the share that comes through up to the distance of occlusion.
pub fn trace_open(lit: &LitNodes, rules: &TraceRules<'_>, apex: DVec3, direction: DVec3) -> (ConeLight, f64) {
    let TraceRules { cones, sampling, occlusion_cells, ref horizon } = *rules;
    // Twice the tangent of half the full apex angle, a leaf at least.
    let half_angle = cones.aperture_degrees.to_radians() / 2.0;
    let diameter = |t: f64| (2.0 * t * half_angle.tan()).max(1.0);
    let (enter, leave) = inside(apex, direction, f64::from(1_u32 << lit.depth));
    let end = leave.min(cones.reach_cells);
    let mut seen = ConeLight { radiance: DVec3::ZERO, through: 1.0 };
    let mut open = 1.0;
    let mut t = enter;
    while t < end {
        let length = (cones.step_diameters * diameter(t)).min(end - t);
        let middle = t + length / 2.0;
        let sample = lit.at_width((sampling, horizon.as_ref()), diameter(middle), apex + direction * middle, direction);
        if sample.alpha > 0.0 {
            let passes = |length: f64| (1.0 - sample.alpha).max(0.0).powf(length);
            if t < occlusion_cells {
                open = seen.through * passes(length.min(occlusion_cells - t));
            }
            let stopped = seen.through * (1.0 - passes(length));
            seen.radiance += sample.radiance / sample.alpha * stopped;
            seen.through -= stopped;
        }
        t += length;
    }
    (seen, open)
}

/// All cones of a leaf; a leaf without a mean normal looks up and down.
pub fn gather(lit: &LitNodes, cones: &Cones, center: DVec3, normal: DVec3) -> ConeLight {
    if normal.length() < SHORT_NORMAL {
        let (up, down) = (hemisphere(lit, cones, center, DVec3::Z), hemisphere(lit, cones, center, DVec3::NEG_Z));
        return ConeLight { radiance: (up.radiance + down.radiance) / 2.0, through: (up.through + down.through) / 2.0 };
    }
    hemisphere(lit, cones, center, normal.normalize())
}

fn hemisphere(lit: &LitNodes, cones: &Cones, center: DVec3, n: DVec3) -> ConeLight {
    let turned = basis(n);
    let weight = 1.0 / f64::from(cones.count);
    cosine_directions(cones.count).into_iter().fold(ConeLight::default(), |sum, direction| {
        let seen = trace(lit, cones, center + n * cones.start_cells, turned * direction);
        ConeLight { radiance: sum.radiance + seen.radiance * weight, through: sum.through + seen.through * weight }
    })
}

/// Distances at which a ray enters and leaves the grid; nothing between them where it misses.
fn inside(origin: DVec3, direction: DVec3, cells: f64) -> (f64, f64) {
    (0..3).fold((0.0, f64::INFINITY), |(enter, leave), axis| {
        let (o, d) = (origin[axis], direction[axis]);
        if d == 0.0 {
            return if (0.0..cells).contains(&o) { (enter, leave) } else { (0.0, 0.0) };
        }
        let (a, b) = (-o / d, (cells - o) / d);
        (enter.max(a.min(b)), leave.min(a.max(b)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_distinct_and_their_weights_sum_to_one() {
        for count in [1, 2, 5, 8, 16, 64, 256] {
            let directions = cosine_directions(count);
            let nearest = |a: usize| (0..a).map(|b| directions[a].distance(directions[b])).fold(f64::MAX, f64::min);
            // Discs of equal area do not come closer than about their own size.
            assert!((1..directions.len()).all(|a| nearest(a) > 1.0 / f64::from(count).sqrt()), "{count}");
            assert!(directions.iter().all(|d| (d.length() - 1.0).abs() < 1e-12 && d.z > 0.0));
            let weight = 1.0 / f64::from(count);
            assert!((directions.len() as f64 * weight - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn equal_weights_are_weights_by_the_cosine() {
        // ∫ cos²θ dω / π = 2/3, and each horizontal axis has a mean of zero.
        let directions = cosine_directions(4096);
        let mean = directions.iter().sum::<DVec3>() / 4096.0;
        assert!(mean.distance(DVec3::new(0.0, 0.0, 2.0 / 3.0)) < 1e-3, "{mean}");
    }

    #[test]
    fn the_basis_is_orthonormal_for_every_axis_and_diagonal() {
        for i in (0..27).filter(|i| *i != 13) {
            let n = DVec3::new(f64::from(i % 3 - 1), f64::from(i / 3 % 3 - 1), f64::from(i / 9 - 1)).normalize();
            let turned = basis(n);
            assert!((turned.transpose() * turned).abs_diff_eq(DMat3::IDENTITY, 1e-14), "{n}");
            assert!((turned.determinant() - 1.0).abs() < 1e-14, "{n}");
            assert_eq!(turned.z_axis, n);
        }
    }
}
