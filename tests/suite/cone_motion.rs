//! Cone light as surfaces and voxels move: no steps at borders of nodes, and smooth under the split filter.

use glam::DVec3;
use octolume::settings::lighting::Opacity;
use octolume::settings::{ConeTracing, Filter, Lookup};
use octolume::stages::cones::diffuse::{DiffuseCones, DiffuseTerms};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::sample::Sampler;

use crate::cone_rig::{SPOT_PX, diffuse, mean, spot};
use crate::device::gpu;
use crate::lit_octree::LitBuild;
use crate::random::{self, ONE};
use crate::stage_build::Shape;
use crate::view_rig::grid;

const DEPTH: u32 = 5;
const LIGHT: DiffuseTerms = DiffuseTerms { radiance: true, occlusion: true };

/// Light and open share at a point, from 64 cones.
fn seen(octree: &LitBuild, opacity: Opacity, (point, face): (DVec3, DVec3)) -> [f64; 2] {
    let photo = spot(gpu(), &grid(DEPTH), point, face);
    let cones = DiffuseCones::new(&ConeTracing::default(), 1 << DEPTH, 0.25);
    let sampler = Sampler { opacity, ..Sampler::default() };
    let input = (&octree.sampled(Lookup::Ranks), &sampler);
    let [red, _, _, open] = mean(&diffuse(gpu(), input, &photo, (&cones, LIGHT), ([0.5; 3], [SPOT_PX; 2])));
    [red, open]
}

/// Largest change between neighbours.
fn largest(values: &[[f64; 2]]) -> f64 {
    let change = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]).abs().max((pair[1][1] - pair[0][1]).abs());
    values.windows(2).map(change).fold(0.0, f64::max)
}

#[test]
fn no_step_at_a_border_of_nodes_is_larger_than_inside() {
    let voxels = random::scene(61, 400, DEPTH);
    let light = |cell: [u32; 3], a: f64| (DVec3::splat(f64::from(cell[0] % 3)), a);
    let octree = LitBuild::new(gpu(), &voxels, &Shape::new(DEPTH, 3, Filter::Split), light);
    let face = DVec3::new(0.1, 0.2, 0.97).normalize();
    for (opacity, direction) in [(Opacity::Isotropic, DVec3::X), (Opacity::Directional, DVec3::new(0.8, 0.6, 0.0))] {
        let (mut at_borders, mut inside) = (0.0_f64, 0.0_f64);
        let place = |step: i32| DVec3::new(8.01, 10.3, 9.2) + direction * f64::from(step) / 16.0;
        let values: Vec<_> = (0..=256).map(|step| seen(&octree, opacity, (place(step), face))).collect();
        for (step, pair) in values.windows(2).enumerate() {
            // Nodes of two cells and wider begin here, and their centres lie half-way.
            let cell = |step: usize| (place(step as i32).x / 2.0).floor();
            let change = largest(pair);
            if cell(step) == cell(step + 1) { inside = inside.max(change) } else { at_borders = at_borders.max(change) }
        }
        println!("{opacity:?}: largest change in 1/16 cell {at_borders:.4} at borders of nodes, {inside:.4} inside");
        assert!(at_borders <= inside, "{opacity:?}: {at_borders} at borders, {inside} inside");
    }
}

/// A block of voxels that is `shift` 32nds of a voxel on its way along x, a floor below, a bright wall beside.
fn moving(filter: Filter, shift: i64) -> LitBuild {
    let solid = |low: [i64; 3], high: [i64; 3], offset: i64| {
        let size = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        (0..size.iter().product::<i64>()).map(move |i| {
            let cell = [low[0] + i % size[0], low[1] + i / size[0] % size[1], low[2] + i / (size[0] * size[1])];
            let q = [cell[0] * ONE + offset, cell[1] * ONE, cell[2] * ONE];
            Fragment { q, normal: [511, 511, 1022], albedo: [128; 3], coverage: 255 }
        })
    };
    let block = solid([10, 12, 6], [15, 18, 16], shift * ONE / 32);
    let all: Vec<_> = solid([0, 0, 4], [32, 32, 5], 0).chain(solid([26, 0, 4], [30, 32, 28], 0)).chain(block).collect();
    let bright = |cell: [u32; 3]| if cell[0] >= 26 { 4.0 } else { 0.2 };
    LitBuild::new(gpu(), &all, &Shape::new(DEPTH, 3, filter), |cell, a| (DVec3::splat(bright(cell)), a))
}

#[test]
fn a_moving_block_changes_light_at_most_a_quarter_as_abruptly_when_split() {
    let steps = [Filter::Split, Filter::Nearest].map(|filter| {
        let mut series = vec![Vec::new(); 3];
        for shift in 0..=32 {
            let octree = moving(filter, shift);
            let along = shift as f64 / 32.0;
            // Beside the block on the floor, in its shadow from the wall, and on its own faces.
            let floor = |x: f64| (DVec3::new(x, 15.2, 4.5), DVec3::Z);
            let own = (DVec3::new(14.5 + along, 15.2, 11.3), DVec3::X);
            for (values, point) in series.iter_mut().zip([floor(18.2), floor(7.1), own]) {
                values.push(seen(&octree, Opacity::Isotropic, point));
            }
        }
        series.into_iter().map(|values| largest(&values)).collect::<Vec<f64>>()
    });
    println!("largest change in 32 steps of 1/32 voxel, split and nearest:");
    for (i, place) in ["floor ahead", "floor behind", "the block itself"].iter().enumerate() {
        println!("{place:16}  {:.4}  {:.4}", steps[0][i], steps[1][i]);
    }
    let [split, nearest] = steps.map(|steps| steps.into_iter().fold(0.0, f64::max));
    assert!(split * 4.0 <= nearest, "{split} under split, {nearest} under nearest");
}
