//! Light in the octree: injection and averaging against references, a constant field constant at every
//! level, volume conserved, walls that stay walls along their axis.

use std::f64::consts::PI;

use glam::DVec3;
use octolume::data::albedo::unpack_albedo;
use octolume::data::octree::FULL_WEIGHT;
use octolume::gpu::Gpu;
use octolume::settings::Filter;
use octolume::settings::lighting::Opacity;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::average_light_ref::{self, Lit};
use octolume::stages::light::inject_ref;
use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::light_rig::{LightRig, full};
use crate::octree_rules::{self as rules, Cell};
use crate::random;
use crate::stage_build::Shape;
use crate::stage_checks::{Check, holds};

const DENSE_LEVELS: [u32; 3] = [0, 2, 4];

fn rig(seed: u64, count: usize, dense_level: u32) -> LightRig {
    LightRig::new(gpu(), &random::scene(seed, count, 5), &Shape::new(5, dense_level, Filter::Split))
}

fn random_light(rig: &LightRig, seed: u64) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let mut rng = random::rng(seed);
    let mut some = |most: f32| -> Vec<[f32; 3]> {
        rig.slots.keys().map(|_| [(); 3].map(|()| rng.random_range(0.0..most))).collect()
    };
    (some(1e5), some(1e4))
}

/// Light and opacity of every node from the leaves' by the reference.
fn expected(rig: &LightRig, leaf: impl Fn(Cell, usize) -> Lit) -> Vec<((u32, Cell), Lit)> {
    let depth = rig.built.params.depth;
    let mut below: std::collections::BTreeMap<Cell, Lit> =
        rig.slots.iter().map(|(cell, slot)| (*cell, leaf(*cell, *slot))).collect();
    let mut all: Vec<_> = below.iter().map(|(cell, lit)| ((depth, *cell), *lit)).collect();
    for level in (0..depth).rev() {
        let parents: std::collections::BTreeSet<Cell> = below.keys().map(|cell| cell.map(|c| c / 2)).collect();
        let lit = |cell: &Cell| {
            let child = |i: usize| [0, 1, 2].map(|axis| 2 * cell[axis] + (i >> axis & 1) as u32);
            average_light_ref::average(&std::array::from_fn(|i| below.get(&child(i)).copied().unwrap_or_default()))
        };
        below = parents.iter().map(|cell| (*cell, lit(cell))).collect();
        all.extend(below.iter().map(|(cell, lit)| ((level, *cell), *lit)));
    }
    all
}

/// Where a node's light is stored.
fn entry(rig: &LightRig, nodes: &std::collections::BTreeMap<(u32, Cell), u32>, level: u32, cell: Cell) -> usize {
    match level == rig.built.params.depth {
        true => rig.built.params.inner_node_count as usize + rig.slots[&cell],
        false => nodes[&(level, cell)] as usize,
    }
}

/// Injection and averaging against the references.
pub fn check_store(gpu: &Gpu) -> Check {
    for (dense_level, opacity) in
        DENSE_LEVELS.into_iter().zip([Opacity::Isotropic, Opacity::Directional, Opacity::Directional])
    {
        let rig = rig(3, 900, dense_level);
        let (direct, emission) = random_light(&rig, 4);
        let stored = rig.stored(gpu, &direct, &emission, opacity);
        let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        let leaf = |_: Cell, slot: usize| {
            let [occupancy, albedo, _] = rig.built.leaves[slot];
            let albedo = unpack_albedo(albedo).into();
            let light = inject_ref::radiance(albedo, vector(direct[slot]), vector(emission[slot]));
            Lit::leaf(light.to_array(), f64::from(occupancy) / f64::from(FULL_WEIGHT))
        };
        let nodes = rules::walk(&rig.built).expect("walks");
        let (inner, leaves) = (rig.built.params.inner_node_count as usize, rig.built.params.leaf_count as usize);
        for ((level, cell), lit) in expected(&rig, leaf) {
            let at = entry(&rig, &nodes, level, cell);
            let found = stored[at].map(f64::from);
            // Eight roundings a level.
            let tolerance = f64::from(8 * 6 * 4) * f64::from(f32::EPSILON);
            for channel in 0..3 {
                let off = (found[channel] - lit.light[channel]).abs();
                holds(off <= tolerance * lit.light[channel], || format!("{level} {cell:?}: {found:?} is not {lit:?}"))?;
            }
            let off = (found[3] - lit.opacity).abs();
            holds(off <= 1e-6 * lit.opacity, || format!("{level} {cell:?}: {found:?}, {lit:?}"))?;
            if opacity == Opacity::Directional && level < rig.built.params.depth {
                let along = stored[inner + leaves + at].map(f64::from);
                let off = (0..3).map(|axis| (along[axis] - lit.along[axis]).abs()).fold(0.0, f64::max);
                holds(off <= tolerance, || format!("{level} {cell:?}: {along:?} is not {:?}", lit.along))?;
            }
        }
    }
    Ok(())
}

#[test]
fn leaves_and_means_are_as_their_references_say() {
    assert_eq!(check_store(gpu()), Ok(()));
}

#[test]
fn empty_nodes_and_dummies_hold_no_light() {
    let rig = rig(3, 60, 0);
    let (direct, emission) = random_light(&rig, 1);
    let stored = rig.stored(gpu(), &direct, &emission, Opacity::Directional);
    let mut empty = 0;
    for ((level, cell), index) in rules::walk(&rig.built).expect("walks") {
        if level < 5 && !rig.slots.keys().any(|leaf| leaf.map(|c| c >> (5 - level)) == cell) {
            assert_eq!(stored[index as usize], [0.0; 4], "node {cell:?} of level {level}");
            empty += 1;
        }
    }
    assert!(empty > 100);
}

#[test]
fn a_constant_field_is_constant_at_every_level_and_volume_is_conserved() {
    for filter in [Filter::Nearest, Filter::Split] {
        let voxels = random::scene(9, 1200, 5);
        let rig = LightRig::new(gpu(), &voxels, &Shape::new(5, 2, filter));
        // Emission alone: radiance 3 everywhere, whatever the albedo.
        let dark = vec![[0.0; 3]; rig.slots.len()];
        let stored = rig.stored(gpu(), &dark, &vec![[3.0; 3]; rig.slots.len()], Opacity::Isotropic);
        let volume: f64 = rig.slots.keys().map(|cell| rig.occupancy(*cell).expect("a leaf")).sum();
        let nodes = rules::walk(&rig.built).expect("walks");
        for level in 0..5 {
            let of_level = nodes.range((level, [0; 3])..(level + 1, [0; 3]));
            let entries: Vec<[f64; 4]> = of_level.map(|(_, index)| stored[*index as usize].map(f64::from)).collect();
            for [r, _, _, opacity] in entries.iter().filter(|entry| entry[3] > 0.0) {
                assert!((r / opacity - 3.0).abs() < 1e-5, "level {level}: {}", r / opacity);
            }
            let found: f64 = entries.iter().map(|entry| entry[3]).sum::<f64>() * f64::from(8_u32.pow(5 - level));
            assert!((found - volume).abs() < 1e-6 * volume, "level {level}: {found} of {volume} cells");
        }
    }
}

#[test]
fn nothing_small_vanishes_beside_much() {
    // One dim leaf in an empty grid beside a bright one far away.
    let voxels = [full([0, 0, 0], DVec3::Y, [255; 3]), full([31, 31, 31], DVec3::Y, [255; 3])];
    let rig = LightRig::new(gpu(), &voxels, &Shape::new(5, 2, Filter::Nearest));
    let emission = [[1e-9, 0.0, 0.0], [0.0, 1e6, 0.0]];
    let stored = rig.stored(gpu(), &[[0.0; 3]; 2], &emission, Opacity::Isotropic);
    let [red, green, _, opacity] = stored[0].map(f64::from);
    let volume = 32_f64.powi(3);
    assert!((red * volume - 1e-9).abs() < 1e-14 && (green * volume - 1e6).abs() < 1.0, "{red} {green}");
    assert!((opacity * volume - 2.0).abs() < 1e-6);
}

#[test]
fn radiance_above_one_survives_and_a_white_plane_leaves_irradiance_over_pi() {
    let rig = LightRig::new(gpu(), &[full([3, 3, 3], DVec3::Y, [255; 3])], &Shape::new(4, 2, Filter::Nearest));
    let stored = rig.stored(gpu(), &[[1e5, 1.0, 0.0]], &[], Opacity::Isotropic);
    let leaf = stored[rig.built.params.inner_node_count as usize].map(f64::from);
    assert!((leaf[0] - 1e5 / PI).abs() < 1e-2 && (leaf[1] - 1.0 / PI).abs() < 1e-6, "{leaf:?}");
}

#[test]
fn a_wall_stays_opaque_across_at_every_level_by_direction_and_thins_without() {
    // One voxel thick, aligned: x = 12 of 32.
    let wall: Vec<Fragment> = (0..32 * 32).map(|i| full([12, i % 32, i / 32], DVec3::X, [255; 3])).collect();
    let rig = LightRig::new(gpu(), &wall, &Shape::new(5, 3, Filter::Nearest));
    let lit = vec![[1.0; 3]; rig.slots.len()];
    let stored = rig.stored(gpu(), &lit, &[], Opacity::Directional);
    let nodes = rules::walk(&rig.built).expect("walks");
    let (inner, leaves) = (rig.built.params.inner_node_count as usize, rig.built.params.leaf_count as usize);
    let mut along = 1.0;
    for level in (0..5).rev() {
        // Along the wall half of the columns are open; that those of the next level up lie behind each
        // other is not known to it, so it stops more than the share of volume.
        along = 0.5 * (1.0 - (1.0_f64 - along).powi(2));
        let width = f64::from(1 << (5 - level));
        let at = nodes[&(level, [12 >> (5 - level), 0, 0])] as usize;
        assert!((f64::from(stored[at][3]) - 1.0 / width).abs() < 1e-6, "isotropic: one layer of {width}");
        let [across, up, aside, _] = stored[inner + leaves + at].map(f64::from);
        assert_eq!(across, 1.0, "level {level}");
        assert!((up - along).abs() < 1e-6 && (aside - along).abs() < 1e-6, "along the wall {up}");
    }
}
