//! Lit octrees and places to sample them at.

use glam::DVec3;
use octolume::settings::lighting::Opacity;
use octolume::settings::{Filter, Lookup, Sampling};
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use crate::device::gpu;
use crate::lit_octree::LitBuild;
use crate::octree::aligned;
use crate::octree_rules::Cell;
use crate::random;
use crate::stage_build::Shape;

pub const DEPTH: u32 = 5;
pub const CELLS: f32 = 32.0;
pub const SAMPLINGS: [Sampling; 3] = [Sampling::Nearest, Sampling::Trilinear, Sampling::Quadrilinear];
pub const OPACITIES: [Opacity; 2] = [Opacity::Isotropic, Opacity::Directional];
pub const LOOKUPS: [Lookup; 3] = [Lookup::Ranks, Lookup::BlockPointers, Lookup::NodePointers];

/// Some bright, some dark, from the cell alone.
pub fn colourful(cell: Cell, opacity: f64) -> (DVec3, f64) {
    let part = |axis: usize, factor: u32| f64::from(cell[axis] * factor % 17) * 0.3;
    (DVec3::new(part(0, 5), part(1, 3), part(2, 7)), opacity)
}

pub fn random_octree(seed: u64, count: usize, dense_level: u32) -> LitBuild {
    LitBuild::new(gpu(), &random::scene(seed, count, DEPTH), &Shape::new(DEPTH, dense_level, Filter::Split), colourful)
}

/// A full grid of opacity `a` and radiance `radiance`.
pub fn constant_field(radiance: DVec3, a: f64, dense_level: u32) -> LitBuild {
    let n = CELLS as i64;
    let voxels: Vec<Fragment> = (0..n * n * n).map(|i| aligned([i % n, i / n % n, i / (n * n)])).collect();
    LitBuild::new(gpu(), &voxels, &Shape::new(DEPTH, dense_level, Filter::Nearest), |_, _| (radiance, a))
}

/// Anywhere in the grid and around it, faces and centres of cells among them.
fn position(rng: &mut TestRng) -> [f32; 3] {
    match rng.random_range(0..4) {
        0 => [(); 3].map(|()| rng.random_range(-4..80) as f32 * 0.5),
        _ => [(); 3].map(|()| rng.random_range(-2.0..CELLS + 2.0)),
    }
}

/// What the sampler takes beside the position.
pub fn level_or_width(rng: &mut TestRng, sampling: Sampling) -> f32 {
    match sampling {
        Sampling::Quadrilinear => rng.random_range(-1.0..7.0_f32).exp2(),
        _ => rng.random_range(0..=DEPTH) as f32,
    }
}

pub fn points(seed: u64, count: usize, sampling: Sampling) -> Vec<[f32; 4]> {
    let mut rng = random::rng(seed);
    let point = |_| {
        let [x, y, z] = position(&mut rng);
        [x, y, z, level_or_width(&mut rng, sampling)]
    };
    (0..count).map(point).collect()
}

pub fn direction() -> DVec3 {
    DVec3::new(0.6, -0.48, 0.64)
}

/// Trilinear weights are off by the rounding of p / width − ½, at most 2^-24 · 34 an axis and so three
/// times that for a product; sums and blends of 16 values add 32 roundings, log2 of the width 2^-21 of a
/// blend. Under directional opacity pow adds 2^-21 of 1 (WGSL lets it inherit exp2 and log2).
pub fn tolerance(largest: f64, opacity: Opacity) -> f64 {
    let roundings = 3.0 * 34.0 + 32.0 + 8.0 + if opacity == Opacity::Directional { 64.0 } else { 0.0 };
    largest.max(1.0) * roundings * 2.0_f64.powi(-24)
}
