//! Sampling the lit octree: against the f64 reference and closed forms; every look-up gives the same bits.

use glam::{DVec3, Vec3};
use octolume::gpu::Gpu;
use octolume::settings::lighting::Opacity;
use octolume::settings::{Filter, Lookup, Sampling};
use octolume::stages::sample::sample_points_ref::{LitNodes, Sampled};
use octolume::stages::sample::{SampledOctree, Sampler};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use crate::device::{gpu, open};
use crate::lit_octree::LitBuild;
use crate::octree::aligned;
use crate::random;
use crate::sampling_rig::{
    CELLS, DEPTH, LOOKUPS, OPACITIES, SAMPLINGS, colourful, constant_field, direction, level_or_width, points,
    random_octree, tolerance,
};
use crate::stage_build::Shape;
use crate::stage_checks::{Check, holds};

fn reference(lit: &LitNodes, sampling: Sampling, direction: DVec3, point: &[f32; 4]) -> Sampled {
    let [x, y, z, at] = point.map(f64::from);
    let p = DVec3::new(x, y, z);
    match sampling {
        Sampling::Nearest => lit.nearest(at as u32, p, direction),
        Sampling::Trilinear => lit.trilinear(at as u32, p, direction),
        Sampling::Quadrilinear => lit.quadrilinear(at, p, direction),
    }
}

/// How far α per cell may be off in a homogeneous medium where a node stores its opacity a across in f32:
/// three roundings of a number near 1, times ∂α/∂a = (1 − a)^(1/w − 1) / w, at worst at the root.
fn across_slack(alpha: f64) -> f64 {
    let w = f64::from(CELLS);
    3.0 * 2.0_f64.powi(-24) * (1.0 - alpha).powf(1.0 - w) / w
}

fn check_matches(gpu: &Gpu, octree: &LitBuild, sampler: &Sampler, points: &[[f32; 4]]) -> Check {
    let lit = octree.lit(sampler.opacity);
    let largest = 0.3 * 16.0;
    let mut seen = 0;
    for (point, found) in points.iter().zip(octree.sample(gpu, sampler, direction(), points)) {
        let expected = reference(&lit, sampler.sampling, direction().as_vec3().as_dvec3(), point);
        let off = (Vec3::from_slice(&found).as_dvec3() - expected.radiance).abs().max_element();
        let alpha_off = (f64::from(found[3]) - expected.alpha).abs();
        let limit = tolerance(largest, sampler.opacity);
        holds(off.max(alpha_off) < limit, || format!("{sampler:?} {point:?}: {found:?} is not {expected:?}"))?;
        seen += usize::from(expected.alpha > 0.0);
    }
    holds(seen * 4 > points.len(), || format!("{seen} of {} points see anything", points.len()))
}

/// A sampler by ranks against the reference, on a random scene.
pub fn check_sampler(gpu: &Gpu, dense_level: u32, (sampling, opacity): (Sampling, Opacity)) -> Check {
    let octree = random_octree(50 + u64::from(dense_level), 2500, dense_level);
    let sampler = Sampler { sampling, opacity, ..Sampler::default() };
    check_matches(gpu, &octree, &sampler, &points(60, 3000, sampling))
}

#[test]
fn every_sampler_matches_the_reference_at_every_dense_level() {
    for dense_level in 0..DEPTH {
        for sampler in SAMPLINGS.into_iter().flat_map(|sampling| OPACITIES.map(|opacity| (sampling, opacity))) {
            assert_eq!(check_sampler(gpu(), dense_level, sampler), Ok(()), "dense level {dense_level}");
        }
    }
}

#[test]
fn ranks_and_pointers_give_the_same_bits() {
    for (dense_level, count) in [(0, 5), (0, 1500), (2, 700), (4, 3000)] {
        let octree = random_octree(70, count, dense_level);
        for sampling in SAMPLINGS {
            let points = points(80 + count as u64, 20_000, sampling);
            for opacity in OPACITIES {
                let bits = LOOKUPS.map(|lookup| {
                    let sampled = octree.sample(gpu(), &Sampler { sampling, lookup, opacity }, direction(), &points);
                    bytemuck::pod_collect_to_vec::<[f32; 4], u32>(&sampled)
                });
                assert!(bits[0] == bits[1], "{sampling:?}, pointers of blocks, dense level {dense_level}");
                assert!(bits[0] == bits[2], "{sampling:?}, pointers of nodes, dense level {dense_level}");
            }
        }
    }
}

#[test]
fn every_workgroup_size_samples_alike() {
    let points = points(90, 5000, Sampling::Quadrilinear);
    let all = [32, 64, 256].map(|size| {
        let gpu = open().with_workgroup_size(size);
        let voxels = random::scene(91, 800, DEPTH);
        let octree = LitBuild::new(&gpu, &voxels, &Shape::new(DEPTH, 2, Filter::Split), colourful);
        octree.sample(&gpu, &Sampler::default(), direction(), &points)
    });
    assert!(all.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn past_every_face_the_sample_is_zero() {
    // Whatever wrapped a row would find a full grid.
    let octree = constant_field(DVec3::ONE, 0.5, 1);
    for (sampling, lookup) in SAMPLINGS.iter().flat_map(|s| LOOKUPS.map(|l| (*s, l))) {
        for level in 0..=DEPTH {
            let width = (1 << (DEPTH - level)) as f32;
            let at = if sampling == Sampling::Quadrilinear { width } else { level as f32 };
            // Half a node outside the grid even the last corner has no weight.
            let beyond = |axis: usize, side: f32, by: f32| {
                let mut p = [CELLS / 2.0 + 0.3; 3];
                p[axis] = if side < 0.0 { -by } else { CELLS + by };
                [p[0], p[1], p[2], at]
            };
            let outside: Vec<_> = (0..3)
                .flat_map(|axis| [-1.0, 1.0].map(|side| (axis, side)))
                .flat_map(|(axis, side)| [width, 0.5 * width, 3.0e9].map(|by| beyond(axis, side, by)))
                .collect();
            let sampler = Sampler { sampling, lookup, opacity: Opacity::Isotropic };
            let found = octree.sample(gpu(), &sampler, DVec3::X, &outside);
            assert!(found.iter().all(|sample| *sample == [0.0; 4]), "{sampler:?}, level {level}: {found:?}");
        }
    }
}

#[test]
fn a_lone_voxel_spreads_over_its_neighbours_and_no_further() {
    let mut rng = random::rng(95);
    for _ in 0..10 {
        let cell = [(); 3].map(|()| rng.random_range(0..i64::from(CELLS as u32)));
        let shape = Shape::new(DEPTH, 0, Filter::Nearest);
        let octree = LitBuild::new(gpu(), &[aligned(cell)], &shape, |_, _| (DVec3::ONE, 1.0));
        let points = points(96, 2000, Sampling::Trilinear).into_iter().map(|p| [p[0], p[1], p[2], DEPTH as f32]);
        let near = |rng: &mut TestRng| cell.map(|c| c as f32 + rng.random_range(-1.0..2.0));
        let points: Vec<_> = points
            .chain((0..500).map(|_| {
                let [x, y, z] = near(&mut rng);
                [x, y, z, DEPTH as f32]
            }))
            .collect();
        for lookup in LOOKUPS {
            let sampler = Sampler { sampling: Sampling::Trilinear, lookup, opacity: Opacity::Isotropic };
            for (point, found) in points.iter().zip(octree.sample(gpu(), &sampler, DVec3::X, &points)) {
                // The tent function of each axis.
                let tent = |axis: usize| (1.0 - (f64::from(point[axis]) - cell[axis] as f64 - 0.5).abs()).max(0.0);
                let expected = tent(0) * tent(1) * tent(2);
                assert!(
                    (f64::from(found[3]) - expected).abs() < tolerance(1.0, Opacity::Isotropic),
                    "{cell:?} {point:?}"
                );
                assert!(expected > 0.0 || found == [0.0; 4]);
            }
        }
    }
}

#[test]
fn a_constant_field_is_constant_at_every_level_and_width() {
    let radiance = DVec3::new(0.25, 3.0, 70_000.0);
    let octree = constant_field(radiance, 0.3, 2);
    let mut rng = random::rng(97);
    for sampling in SAMPLINGS {
        for opacity in OPACITIES {
            let inside = |rng: &mut TestRng| {
                let at = level_or_width(rng, sampling);
                // Half a node from the border of the coarser level on, every corner is in the grid.
                let width = match sampling {
                    Sampling::Quadrilinear => at.max(1.0).log2().ceil().exp2(),
                    _ => (DEPTH as f32 - at).exp2(),
                }
                .min(CELLS);
                let [x, y, z] = [(); 3].map(|()| rng.random_range(0.0..=1.0_f32) * (CELLS - width) + 0.5 * width);
                [x, y, z, at]
            };
            let points: Vec<_> = (0..4000).map(|_| inside(&mut rng)).collect();
            let sampler = Sampler { sampling, opacity, ..Sampler::default() };
            for (point, found) in points.iter().zip(octree.sample(gpu(), &sampler, direction(), &points)) {
                let across = if opacity == Opacity::Directional { across_slack(0.3) } else { 0.0 };
                let slack = tolerance(1.0, opacity) + across;
                assert!((f64::from(found[3]) - 0.3).abs() < slack, "{point:?}: {found:?}");
                let color = Vec3::from_slice(&found).as_dvec3() / f64::from(found[3]);
                assert!(
                    (color / radiance - 1.0).abs().max_element() < tolerance(1.0, Opacity::Isotropic),
                    "{point:?}: {found:?}"
                );
            }
        }
    }
}

#[test]
fn partial_occupancy_divides_out_of_a_constant_radiance() {
    let voxels = random::scene(98, 3000, DEPTH);
    let octree = LitBuild::new(gpu(), &voxels, &Shape::new(DEPTH, 1, Filter::Split), |_, a| (DVec3::splat(5.0), a));
    for sampling in SAMPLINGS {
        for opacity in OPACITIES {
            let points = points(99, 4000, sampling);
            let sampler = Sampler { sampling, opacity, ..Sampler::default() };
            let found = octree.sample(gpu(), &sampler, direction(), &points);
            for sample in found.iter().filter(|sample| sample[3] > 0.0) {
                let color = f64::from(sample[0]) / f64::from(sample[3]);
                assert!((color / 5.0 - 1.0).abs() < tolerance(1.0, Opacity::Isotropic), "{sampler:?}: {sample:?}");
            }
        }
    }
}

#[test]
fn missing_pointers_are_named() {
    let mut octree = random_octree(1, 3, 2);
    octree.buffers.neighbours.free();
    let pointers = octree.buffers.neighbours.get();
    let sampled = |lookup| SampledOctree::new(octree.buffers.octree(), &octree.light, lookup, pointers);
    let error = sampled(Lookup::BlockPointers).expect_err("missing").to_string();
    assert!(error.contains("neighbour pointers"), "{error}");
    assert!(sampled(Lookup::Ranks).is_ok());
}
