//! Rays through the lattice: exactly the cells they cross, in order, whatever their direction.
//! `shared/ray_walk.wgsl` on the GPU against the reference's sorted crossings.

use glam::{DVec3, Vec3};
use octolume::stages::SHADERS;
use octolume::stages::pixels::crossings::crossings;
use proptest::prelude::*;

use crate::ray_rig::{CELLS, MAX_STEPS, WALK, check_by, check_order, walk};

fn check(rays: &[(Vec3, Vec3)]) {
    assert_eq!(check_by(WALK, rays), Ok(()));
}

fn axial_rays() -> Vec<(Vec3, Vec3)> {
    let components = [0.0, -0.0, 1e-20, -1e-20, 1.0, -1.0];
    let starts = [Vec3::new(3.3, 5.7, 8.2), Vec3::new(-2.5, 4.5, 7.5), Vec3::new(20.0, 3.25, 0.75), Vec3::splat(8.0)];
    let mut rays = Vec::new();
    for x in components {
        for y in components {
            for z in components {
                let direction = Vec3::new(x, y, z);
                if direction.abs().max_element() == 1.0 {
                    rays.extend(starts.map(|start| (start, direction.normalize())));
                }
            }
        }
    }
    rays
}

#[test]
fn directions_with_zeros_and_almost_zeros() {
    check(&axial_rays());
}

/// Defects on purpose: the assertions of these tests must see them.
#[test]
fn a_wrong_walk_is_caught() {
    let walk_file = SHADERS.files.iter().find(|(path, _)| *path == "shared/ray_walk.wgsl").expect("embedded").1;
    let slanted: Vec<_> = (0..40_u16)
        .map(|i| f32::from(i) * 0.37)
        .map(|a| (Vec3::new(-4.0, 3.0, 5.0), Vec3::new(1.0, a.sin(), a.cos() * 0.5).normalize()))
        .collect();
    let rays = [axial_rays(), slanted].concat();
    let by = |from: &str, to: &str| {
        assert!(walk_file.contains(from), "{from}");
        check_by(&WALK.replace("#import shared/ray_walk.wgsl", &walk_file.replace(from, to)), &rays)
    };
    assert_eq!(by("", ""), Ok(()));
    for (from, to) in [
        ("select(low - 1, low + size, ray.forward)", "select(low, low + size, ray.forward)"),
        ("select(low, low + size, ray.forward)", "select(low + size, low, ray.forward)"),
        ("let t = max(walk.t, exit.t);", "let t = walk.t;"),
        ("min(times.x, min(times.y, times.z))", "min(times.x, times.y)"),
        ("all(cell >= vec3<i32>(0))", "true"),
    ] {
        by(from, to).expect_err(to);
    }
}

#[test]
fn rays_along_edges_and_through_corners() {
    let mut rays = Vec::new();
    for start in [
        Vec3::ZERO,
        Vec3::new(4.0, 4.0, 4.0),
        Vec3::new(4.0, 4.0, -3.0),
        Vec3::new(-5.0, -5.0, -5.0),
        Vec3::splat(16.0),
        Vec3::splat(21.0),
    ] {
        for x in [-1.0, 0.0, 1.0] {
            for y in [-1.0, 0.0, 1.0] {
                for z in [-1.0, 0.0, 1.0] {
                    if (x, y, z) != (0.0, 0.0, 0.0) {
                        rays.push((start, Vec3::new(x, y, z).normalize()));
                    }
                }
            }
        }
    }
    for (steps, ray) in walk(&rays, CELLS, MAX_STEPS).iter().zip(&rays) {
        assert_eq!(check_order(steps, CELLS, ray), Ok(()));
    }
    // Through corners exactly: the cells of the diagonal have all of the length.
    let diagonal = &walk(&[(Vec3::ZERO, Vec3::ONE.normalize())], CELLS, MAX_STEPS)[0];
    let long: Vec<_> = diagonal.iter().filter(|s| s.leave - s.enter > 1e-4).map(|s| s.cell).collect();
    assert_eq!(long, (0..16).map(|i| [i, i, i]).collect::<Vec<_>>());
}

#[test]
fn every_start_enters_rightly() {
    let along_x = Vec3::X;
    let first = |start: Vec3, direction: Vec3| {
        let steps = &walk(&[(start, direction)], CELLS, MAX_STEPS)[0];
        steps.iter().find(|step| step.leave > step.enter).map(|step| (step.cell, step.enter))
    };
    assert_eq!(first(Vec3::new(5.5, 2.5, 2.5), along_x), Some(([5, 2, 2], 0.0)), "inside");
    assert_eq!(first(Vec3::new(5.0, 2.5, 2.5), along_x), Some(([5, 2, 2], 0.0)), "on a face, ahead");
    assert_eq!(first(Vec3::new(5.0, 2.5, 2.5), -along_x), Some(([4, 2, 2], 0.0)), "on a face, back");
    assert_eq!(first(Vec3::new(0.0, 2.5, 2.5), along_x), Some(([0, 2, 2], 0.0)), "on the grid's face, in");
    assert_eq!(first(Vec3::new(0.0, 2.5, 2.5), -along_x), None, "on the grid's face, out");
    assert_eq!(first(Vec3::new(16.0, 2.5, 2.5), -along_x), Some(([15, 2, 2], 0.0)), "on the far face, in");
    assert_eq!(first(Vec3::new(-4.0, 2.5, 2.5), along_x), Some(([0, 2, 2], 4.0)), "outside, towards");
    assert_eq!(first(Vec3::new(-4.0, 2.5, 2.5), -along_x), None, "outside, away");
    assert_eq!(first(Vec3::new(-4.0, 16.0, 2.5), along_x), None, "along the grid's upper face: cells are half-open");
    assert_eq!(first(Vec3::new(-4.0, 0.0, 2.5), along_x), Some(([0, 0, 2], 4.0)), "along the grid's lower face");
    assert_eq!(first(Vec3::new(-1.0, -1.0, 5.0), Vec3::new(1.0, -1.0, 0.0).normalize()), None, "past it");
}

#[test]
fn a_zero_direction_is_a_miss() {
    for start in [Vec3::splat(3.5), Vec3::ZERO, Vec3::splat(-3.0)] {
        for direction in [Vec3::ZERO, -Vec3::ZERO, Vec3::splat(1e-35)] {
            assert!(walk(&[(start, direction)], CELLS, MAX_STEPS)[0].is_empty());
        }
    }
}

#[test]
fn far_starts_and_large_grids_end_within_3n_steps() {
    let cells = 1024;
    let mut rays = Vec::new();
    for distance in [10.0_f32, 1e4, 1e6] {
        for direction in [Vec3::new(1.0, 0.7, 0.3), Vec3::new(-0.9, 1.0, 0.001), Vec3::new(0.577, -0.578, 0.5765)] {
            let direction = direction.normalize();
            rays.push((Vec3::splat(512.0) - direction * distance, direction));
        }
    }
    for (steps, ray) in walk(&rays, cells, 3 * cells as usize).iter().zip(&rays) {
        assert_eq!(check_order(steps, cells, ray), Ok(()));
        assert!(!steps.is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn random_rays_cross_what_the_definition_says(
        rays in prop::collection::vec((prop::array::uniform3(-10.0_f32..26.0), prop::array::uniform3(-1.0_f32..1.0)), 256),
    ) {
        let rays: Vec<_> = rays
            .into_iter()
            .map(|(start, direction)| (Vec3::from(start), Vec3::from(direction).normalize_or(Vec3::X)))
            .collect();
        check(&rays);
    }
}

#[test]
fn the_reference_crosses_a_length_that_adds_up() {
    let origin = DVec3::new(-3.0, 2.2, 5.1);
    let direction = DVec3::new(0.9, 0.2, 0.3).normalize();
    let crossed = crossings(origin, direction, CELLS);
    let length: f64 = crossed.iter().map(|c| c.to - c.from).sum();
    let through = (crossed[crossed.len() - 1].to - crossed[0].from).abs();
    assert!((length - through).abs() < 1e-12);
    assert_eq!(crossed[0].entered, -DVec3::X);
}
