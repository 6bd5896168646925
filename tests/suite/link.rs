//! Neighbour pointers (section 4.4): against coordinates, and hops against key look-up.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use octolume::data::grid::morton_cell;
use octolume::data::octree::NO_BLOCK;
use octolume::settings::Filter;
use octolume::stages::build::{link_ref, reduce_ref};
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;

use crate::device::{gpu, open};
use crate::lit_octree::LitBuild;
use crate::octree::aligned;
use crate::octree_rules::{self as rules, Cell};
use crate::random::{self, ONE};
use crate::stage_build::Shape;

fn linked(voxels: &[Fragment], shape: &Shape) -> LitBuild {
    LitBuild::new(gpu(), voxels, shape, |_, opacity| (DVec3::ONE, opacity))
}

/// Level and coordinates of the node above every block.
fn blocks(octree: &LitBuild) -> Vec<link_ref::Block> {
    let params = &octree.built.params;
    let level_of = |block: u32| {
        let starts = |level: &u32| params.levels[*level as usize].first_block <= block;
        (params.dense_level..params.depth).filter(starts).max().expect("a level starts at block 0")
    };
    octree.built.block_keys.iter().zip(0..).map(|(key, block)| (level_of(block), morton_cell(*key))).collect()
}

/// Index of every sparse node by level and coordinates, leaves too.
fn node_indices(octree: &LitBuild) -> BTreeMap<(u32, Cell), u32> {
    let children = |(block, (level, cell)): (u32, link_ref::Block)| {
        (0..8).map(move |i| ((level + 1, child(cell, i)), 8 * block + i))
    };
    let dense = octree.built.params.dense_node_count;
    let all = (0..).zip(blocks(octree)).flat_map(children);
    all.map(|(node, index)| (node, dense + index)).collect()
}

fn child(cell: Cell, i: u32) -> Cell {
    [0, 1, 2].map(|axis| 2 * cell[axis] + (i >> axis & 1))
}

fn stored(pointers: &[[Option<u32>; 3]]) -> Vec<[u32; 3]> {
    pointers.iter().map(|three| three.map(|pointer| pointer.unwrap_or(NO_BLOCK))).collect()
}

fn assert_pointers_match(octree: &LitBuild) {
    let blocks = blocks(octree);
    assert!(octree.neighbours == stored(&link_ref::link_blocks(&blocks)));
    let nodes = link_ref::link_nodes(&blocks, octree.built.params.dense_node_count);
    assert!(octree.node_neighbours == stored(&nodes));
}

/// The node ahead along an axis, by either layout.
fn hop(octree: &LitBuild, by_node: bool, node: u32, axis: usize) -> u32 {
    let dense = octree.built.params.dense_node_count;
    if node == NO_BLOCK {
        return NO_BLOCK;
    }
    let (block, i) = ((node - dense) / 8, (node - dense) % 8);
    if by_node {
        return octree.node_neighbours[(node - dense) as usize][axis];
    }
    if i >> axis & 1 == 0 {
        return node + (1 << axis);
    }
    match octree.neighbours[block as usize][axis] {
        NO_BLOCK => NO_BLOCK,
        ahead => dense + 8 * ahead + (i ^ 1 << axis),
    }
}

const AXIS_ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// For every occupied sparse node, from every base node whose interpolation it takes part in: the hops
/// to it, in every axis order, end at the node that its key names.
fn assert_hops_arrive(octree: &LitBuild) {
    let params = octree.built.params;
    let index = node_indices(octree);
    for level in params.dense_level + 1..=params.depth {
        let occupied = match level == params.depth {
            true => rules::cells_of(&octree.built.leaf_bits, level),
            false => rules::occupied_cells(&octree.built, level),
        };
        for cell in occupied {
            for base in reduce_ref::backward_dilate(&BTreeSet::from([cell])) {
                for (order, by_node) in AXIS_ORDERS.iter().flat_map(|order| [(order, false), (order, true)]) {
                    let axes = order.iter().filter(|axis| cell[**axis] > base[**axis]);
                    let end = axes.fold(index[&(level, base)], |node, axis| hop(octree, by_node, node, *axis));
                    assert_eq!(end, index[&(level, cell)], "level {level}: {base:?} to {cell:?}, axes {order:?}");
                }
            }
        }
    }
}

#[test]
fn random_sets_are_linked_as_coordinates_say_and_hops_arrive() {
    for (filter, count) in [(Filter::Split, 400), (Filter::Nearest, 900)] {
        for dense_level in 0..6 {
            let octree =
                linked(&random::scene(20 + u64::from(dense_level), count, 6), &Shape::new(6, dense_level, filter));
            assert_pointers_match(&octree);
            assert_hops_arrive(&octree);
        }
    }
}

#[test]
fn small_and_full_trees_are_linked_as_coordinates_say() {
    for depth in 1..=4 {
        let n = 1_i64 << depth;
        let full: Vec<_> = (0..n * n * n).map(|i| aligned([i % n, i / n % n, i / (n * n)])).collect();
        for dense_level in 0..depth {
            for voxels in [&[][..], &full[..1], &full[full.len() - 1..], &full] {
                let octree = linked(voxels, &Shape::new(depth, dense_level, Filter::Split));
                assert_pointers_match(&octree);
                assert_hops_arrive(&octree);
            }
        }
    }
}

#[test]
fn a_lone_voxel_is_reached_from_all_its_dummies() {
    let mut rng = random::rng(31);
    for _ in 0..20 {
        let cell = [(); 3].map(|()| rng.random_range(0..64));
        assert_hops_arrive(&linked(&[aligned(cell)], &Shape::new(6, 0, Filter::Nearest)));
    }
    // A voxel in eight leaves, across the border of all levels.
    let straddling = Fragment { q: [32 * ONE - ONE / 2; 3], normal: [511; 3], albedo: [1; 3], coverage: 255 };
    assert_hops_arrive(&linked(&[straddling], &Shape::new(6, 0, Filter::Split)));
}

#[test]
fn no_pointer_leaves_the_grid_or_wraps_a_row() {
    for depth in [3, 10] {
        let last = (1_i64 << depth) - 1;
        // Whatever wrapped would find the first cells occupied.
        let corners = (0..8).map(|corner| aligned([0, 1, 2].map(|axis| last * (corner >> axis & 1))));
        let octree = linked(&corners.collect::<Vec<_>>(), &Shape::new(depth, 2, Filter::Nearest));
        assert_pointers_match(&octree);
        let index = node_indices(&octree);
        for ((level, cell), node) in &index {
            for axis in (0..3).filter(|axis| cell[*axis] + 1 == 1 << level) {
                assert_eq!([false, true].map(|by_node| hop(&octree, by_node, *node, axis)), [NO_BLOCK; 2]);
            }
        }
    }
}

#[test]
fn every_workgroup_size_links_alike() {
    let voxels = random::scene(40, 700, 6);
    let shape = Shape::new(6, 2, Filter::Split);
    let all = [32, 64, 256].map(|size| {
        let octree = LitBuild::new(&open().with_workgroup_size(size), &voxels, &shape, |_, a| (DVec3::ONE, a));
        (octree.neighbours, octree.node_neighbours)
    });
    assert!(all.windows(2).all(|pair| pair[0] == pair[1]));
}
