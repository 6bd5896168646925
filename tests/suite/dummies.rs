//! Dummies: the empty nodes behind occupied ones, so that every interpolation corner exists (4.4).

use std::collections::BTreeSet;

use octolume::settings::Filter;
use octolume::stages::build::reduce_ref;
use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::octree::{aligned, build_checked};
use crate::octree_rules as rules;
use crate::random;
use crate::stage_build::Shape;
use crate::stage_rig::{World, world_voxel};

#[test]
fn no_dummy_outside_the_grid_and_none_wraps_a_row() {
    for cell in [[0, 32, 32], [32, 0, 32], [32, 32, 0], [0, 0, 0], [0, 0, 63]] {
        let built = build_checked(gpu(), &[aligned(cell)], &Shape::new(6, 0, Filter::Split));
        for level in 0..6 {
            let near = |node: &[u32; 3]| {
                (0..3).all(|axis| (cell[axis] >> (6 - level)) - i64::from(node[axis]) <= 1)
                    && (0..3).all(|axis| i64::from(node[axis]) <= cell[axis] >> (6 - level))
            };
            let allocated = rules::allocated_cells(&built, level);
            assert!(allocated.iter().all(near), "level {level}: {allocated:?}");
        }
    }
}

#[test]
fn a_lone_voxel_has_all_its_dummies() {
    let mut rng = random::rng(9);
    for _ in 0..12 {
        let cell = [(); 3].map(|()| rng.random_range(0..64));
        let built = build_checked(gpu(), &[aligned(cell)], &Shape::new(6, 0, Filter::Split));
        for level in 0..6 {
            // A node's own block, and the one behind along each axis where the node below is the first of its block.
            let below = cell.map(|c| c >> (5 - level));
            let of_axis = |c: i64| if c > 0 && c % 2 == 0 { 2 } else { 1 };
            let own: u32 = below.iter().map(|&c| of_axis(c)).product();
            let found = rules::allocated_cells(&built, level);
            let wanted = reduce_ref::parents(&reduce_ref::backward_dilate(&BTreeSet::from([below.map(|c| c as u32)])));
            assert_eq!(wanted.len() as u32, own);
            assert!(found.is_superset(&wanted), "level {level} of {cell:?}");
        }
    }
}

#[test]
fn dummies_change_no_average_and_no_leaf() {
    let voxels = random::scene(4, 800, 6);
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let world = World::given(gpu(), &words);
    for dense_level in [0, 3] {
        let shape = Shape::new(6, dense_level, Filter::Split);
        let with = world.build(gpu(), &shape);
        let without = world.build(gpu(), &Shape { dummies: false, ..shape });
        assert!(without.params.block_count < with.params.block_count);
        assert_eq!(rules::leaves(&with), rules::leaves(&without));
        let (index_with, index_without) = (rules::walk(&with).expect("walks"), rules::walk(&without).expect("walks"));
        for (key, index) in &index_with {
            let bare = index_without.get(key).map_or([0; 4], |index| without.nodes[*index as usize]);
            assert_eq!(with.nodes[*index as usize], bare, "node {key:?}");
        }
    }
}
