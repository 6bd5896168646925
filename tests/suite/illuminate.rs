//! Irradiance of the leaves: kernel against reference, falloff and cosine against closed forms, and what
//! must never be infinite.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DVec3, IVec3};
use octolume::gpu::Gpu;
use octolume::lights::PosedLight;
use octolume::scene::LightKind;
use octolume::settings::Filter;
use octolume::settings::lighting::Shadows;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::LEAST_DISTANCE_CELLS;
use octolume::stages::light::illuminate_ref::{self, Light, Source};
use octolume::stages::pixels::SHORT_NORMAL;

use crate::device::gpu;
use crate::light_rig::{LightRig, full, light, point, sun};
use crate::random;
use crate::stage_build::Shape;
use crate::stage_checks::{Check, holds};

fn source(light: &PosedLight) -> Source {
    match light.kind {
        LightKind::Directional => Source::Sun(light.direction),
        LightKind::Point { range } => Source::Point(light.position, range.map(f64::from)),
        LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
            let cosines = [f64::from(inner_cone_radians).cos(), f64::from(outer_cone_radians).cos()];
            Source::Spot(light.position, light.direction, cosines, range.map(f64::from))
        }
    }
}

fn lights() -> Vec<PosedLight> {
    let spot = LightKind::Spot { range: Some(40.0), inner_cone_radians: 0.3, outer_cone_radians: 0.9 };
    vec![
        sun(DVec3::new(0.3, -1.0, 0.2), 5.0),
        point(DVec3::new(9.2, 30.0, 16.1), 700.0),
        light(LightKind::Point { range: Some(25.0) }, DVec3::new(90.0, 10.0, 0.0), DVec3::splat(16.0), DVec3::X),
        light(spot, DVec3::new(300.0, 200.0, 100.0), DVec3::new(4.0, 40.0, 4.0), DVec3::new(1.0, -2.0, 1.0)),
    ]
}

/// A few steps of f32 in each of less than thirty operations, and what a spot's narrow cosine range
/// magnifies: 1 / (cos 0.3 − cos 0.9) squared.
const TOLERANCE: f64 = 30.0 * 10.0 * f32::EPSILON as f64;

/// Packing leaves a unit normal up to this far from length 1, squared: it counts as one.
fn quantised(mean: DVec3) -> DVec3 {
    if (mean.length_squared() - 1.0).abs() < 0.0034 { mean.normalize() } else { mean }
}

/// Every kind of light, unhidden, against the reference.
pub fn check_unhidden(gpu: &Gpu) -> Check {
    for filter in [Filter::Nearest, Filter::Split] {
        let rig = LightRig::new(crate::device::gpu(), &random::scene(5, 600, 5), &Shape::new(5, 3, filter));
        for lit in lights() {
            let found = rig.irradiance(gpu, std::slice::from_ref(&lit), Shadows::Off, 1.5);
            let reference = Light { source: source(&lit), strength: lit.strength };
            for (slot, (centre, mean)) in rig.leaves().into_iter().enumerate() {
                let expected = illuminate_ref::irradiance(&reference, centre, quantised(mean), 1.0);
                let (_, distance) = illuminate_ref::towards(reference.source, centre);
                let most = lit.strength.max_element() / if distance.is_finite() { distance.powi(2) } else { 1.0 };
                let off = (DVec3::from_array(found[slot].map(f64::from)) - expected).abs().max_element();
                holds(off <= TOLERANCE * most, || format!("{lit:?} at {centre}: {:?} is not {expected}", found[slot]))?;
            }
        }
    }
    Ok(())
}

#[test]
fn every_kind_of_light_is_as_its_reference_says() {
    assert_eq!(check_unhidden(gpu()), Ok(()));
}

/// Every kind of light, hidden by leaves, against the reference.
pub fn check_marched(gpu: &Gpu) -> Check {
    let rig = LightRig::new(crate::device::gpu(), &random::scene(8, 500, 5), &Shape::new(5, 3, Filter::Split));
    let alpha = |cell: IVec3| rig.occupancy(cell.to_array().map(|c| c as u32));
    for lit in lights() {
        let found = rig.irradiance(gpu, std::slice::from_ref(&lit), Shadows::March, 1.5);
        let open = rig.irradiance(gpu, std::slice::from_ref(&lit), Shadows::Off, 1.5);
        let mut hidden = 0;
        for (slot, (centre, mean)) in rig.leaves().into_iter().enumerate() {
            let (to_light, _) = illuminate_ref::towards(source(&lit), centre);
            let unit = mean.normalize_or_zero();
            let away = if mean.length() >= SHORT_NORMAL && unit.dot(to_light) > 0.0 { unit } else { to_light };
            let start = centre + 1.5 * away;
            let (direction, length) = match source(&lit) {
                Source::Sun(_) => (to_light, f64::INFINITY),
                Source::Point(position, _) | Source::Spot(position, ..) => {
                    ((position - start).normalize(), (position - start).length())
                }
            };
            let through = illuminate_ref::transmittance(start, direction, length, 32, alpha);
            let (found, open) = (f64::from(found[slot][0]), f64::from(open[slot][0]));
            // Rays that f32 cannot tell from a grazing one differ by a cell's corner at most.
            holds((found - open * through).abs() <= 2e-3 * open.max(1e-6), || {
                format!("{centre}: {found}, {open} x {through}")
            })?;
            hidden += usize::from(through < 0.5);
        }
        holds(hidden > 10, || format!("{hidden} leaves are hidden"))?;
    }
    Ok(())
}

#[test]
fn marched_visibility_is_what_the_leaves_on_the_way_let_through() {
    assert_eq!(check_marched(gpu()), Ok(()));
}

#[test]
fn lengths_of_the_scene_are_lengths_whatever_a_cell_spans() {
    let grid = crate::view_rig::grid(5);
    let rig = LightRig::new(gpu(), &random::scene(5, 600, 5), &Shape::new(5, 3, Filter::Split));
    let world = |cells: DVec3| grid.corner() + cells * grid.span;
    let scaled = |range: Option<f32>| range.map(|range| range * grid.span as f32);
    for lit in lights() {
        let kind = match lit.kind {
            LightKind::Directional => LightKind::Directional,
            LightKind::Point { range } => LightKind::Point { range: scaled(range) },
            LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
                LightKind::Spot { range: scaled(range), inner_cone_radians, outer_cone_radians }
            }
        };
        let lit = PosedLight { kind, position: world(lit.position), ..lit };
        let found = rig.irradiance_in(gpu(), &grid, std::slice::from_ref(&lit), Shadows::Off, 1.5);
        let reference = Light { source: source(&lit), strength: lit.strength };
        let mut compared = 0;
        for (slot, (centre, mean)) in rig.leaves().into_iter().enumerate() {
            // Lux and candela over the square of metres: the reference counts in any unit, but nearer than its least
            // distance.
            let (_, distance) = illuminate_ref::towards(reference.source, world(centre));
            if distance <= LEAST_DISTANCE_CELLS {
                continue;
            }
            let expected = illuminate_ref::irradiance(&reference, world(centre), quantised(mean), 1.0);
            let most = lit.strength.max_element() / if distance.is_finite() { distance.powi(2) } else { 1.0 };
            let off = (DVec3::from_array(found[slot].map(f64::from)) - expected).abs().max_element();
            assert!(off <= TOLERANCE * most, "{lit:?} at {centre}: {:?} is not {expected}", found[slot]);
            compared += 1;
        }
        assert!(compared > 500, "{compared}");
    }
}

/// A wall of voxels in the plane y = 0, one cell thick, facing up.
fn wall(cells: i64) -> Vec<Fragment> {
    let up = |i: i64| full([i % cells, 0, i / cells], DVec3::Y, [255; 3]);
    (0..cells * cells).map(up).collect()
}

#[test]
fn a_point_light_over_a_wall_falls_off_with_distance_and_cosine() {
    let rig = LightRig::new(gpu(), &wall(32), &Shape::new(5, 3, Filter::Nearest));
    let position = DVec3::new(16.0, 9.0, 16.0);
    for shadows in [Shadows::Off, Shadows::March] {
        let found = rig.irradiance(gpu(), &[point(position, 1000.0)], shadows, 1.5);
        for (slot, (centre, _)) in rig.leaves().into_iter().enumerate() {
            let to_light = position - centre;
            // I·cosθ/d²: of the height over d³.
            let expected = 1000.0 * to_light.y / to_light.length().powi(3);
            let off = (f64::from(found[slot][1]) - expected).abs();
            assert!(off < 1e-5 * expected, "{shadows:?} at {centre}: {:?} is not {expected}", found[slot]);
        }
    }
}

#[test]
fn a_sun_over_a_wall_is_its_cosine_everywhere() {
    let rig = LightRig::new(gpu(), &wall(16), &Shape::new(4, 3, Filter::Split));
    for degrees in [0.0, 30.0, 60.0, 85.0_f64] {
        let angle = degrees.to_radians();
        let found = rig.irradiance(gpu(), &[sun(DVec3::new(angle.sin(), -angle.cos(), 0.0), 100.0)], Shadows::Off, 1.5);
        assert!(found.iter().flatten().all(|e| (f64::from(*e) - 100.0 * angle.cos()).abs() < 1e-3), "{degrees}");
    }
    let below = rig.irradiance(gpu(), &[sun(DVec3::Y, 100.0)], Shadows::Off, 1.5);
    assert!(below.iter().all(|e| *e == [0.0; 3]), "back-facing");
}

#[test]
fn light_is_linear_and_additive() {
    let rig = LightRig::new(gpu(), &random::scene(2, 400, 5), &Shape::new(5, 3, Filter::Split));
    let all = lights();
    let together = rig.irradiance(gpu(), &all, Shadows::March, 1.5);
    let mut sum = vec![DVec3::ZERO; together.len()];
    for lit in &all {
        let alone = rig.irradiance(gpu(), std::slice::from_ref(lit), Shadows::March, 1.5);
        let doubled = PosedLight { strength: lit.strength * 2.0, ..lit.clone() };
        let twice = rig.irradiance(gpu(), &[doubled], Shadows::March, 1.5);
        for ((sum, one), two) in sum.iter_mut().zip(&alone).zip(&twice) {
            *sum += DVec3::from_array(one.map(f64::from));
            assert_eq!(*two, one.map(|e| 2.0 * e), "twice the light, to the bit");
        }
    }
    for (found, sum) in together.iter().zip(sum) {
        assert!((DVec3::from_array(found.map(f64::from)) - sum).abs().max_element() <= 1e-6 * sum.max_element());
    }
}

#[test]
fn nothing_is_infinite_where_a_light_is_in_a_leaf_or_a_normal_has_no_length() {
    let opposed = [full([8, 8, 8], DVec3::Y, [255; 3]), full([8, 8, 8], DVec3::NEG_Y, [255; 3])];
    let rig = LightRig::new(gpu(), &opposed, &Shape::new(4, 3, Filter::Nearest));
    for shadows in [Shadows::Off, Shadows::March, Shadows::Map] {
        let inside = rig.irradiance(gpu(), &[point(DVec3::splat(8.5), 1.0)], shadows, 1.5);
        assert!(inside[0].iter().all(|e| e.is_finite()), "{shadows:?}: {inside:?}");
        let above = rig.irradiance(gpu(), &[point(DVec3::new(8.5, 12.5, 8.5), 16.0)], shadows, 1.5);
        // Cancelled normals face every way: a quarter of 16 candela at 4 cells.
        assert!((above[0][0] - 0.25).abs() < 1e-6, "{shadows:?}: {above:?}");
        let spot = LightKind::Spot { range: None, inner_cone_radians: 0.0, outer_cone_radians: FRAC_PI_4 as f32 };
        let away = light(spot, DVec3::ONE, DVec3::new(8.5, 12.5, 8.5), DVec3::Y);
        assert_eq!(rig.irradiance(gpu(), &[away], shadows, 1.5), [[0.0; 3]], "behind a spot");
    }
}

#[test]
fn a_leaf_is_not_in_its_own_shadow() {
    // A slanted plane, split over the cells around it: nothing is above it.
    let normal = DVec3::new(1.0, 2.0, 0.5).normalize();
    let plane = |i: i64| {
        let (x, z) = ((i % 24) as f64, (i / 24) as f64);
        let y = 14.0 - (x * normal.x + z * normal.z) / normal.y;
        Fragment { q: [x, y, z].map(|c| (c * 256.0).round() as i64), ..full([0; 3], normal, [255; 3]) }
    };
    let voxels: Vec<_> = (0..24 * 24).map(plane).filter(|voxel| voxel.q[1] >= 0).collect();
    let rig = LightRig::new(gpu(), &voxels, &Shape::new(5, 3, Filter::Split));
    for direction in [-normal, DVec3::NEG_Y, DVec3::new(-1.0, -1.0, -0.4)] {
        let lit = [sun(direction, 1.0)];
        let open = rig.irradiance(gpu(), &lit, Shadows::Off, 2.0);
        let shadowed = rig.irradiance(gpu(), &lit, Shadows::March, 2.0);
        let lost: f32 = open.iter().zip(&shadowed).map(|(open, shadowed)| open[0] - shadowed[0]).sum();
        let all: f32 = open.iter().map(|open| open[0]).sum();
        assert!(
            lost < 0.01 * all,
            "{direction}: {lost} of {all} lost, {} degrees",
            normal.dot(-direction.normalize()).acos() * 180.0 / PI
        );
    }
}
