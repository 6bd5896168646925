//! Inner nodes: occupied volume adds up, colour and normal are means weighted by it.

use octolume::settings::Filter;
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::octree_rules as rules;
use crate::random::{self, ONE};
use crate::stage_build::{Built, Shape};
use crate::stage_checks::Expected;
use crate::stage_rig::{World, world_voxel};

const DENSE_LEVELS: [u32; 3] = [0, 2, 4];

fn build(voxels: &[Fragment], dense_level: u32) -> Built {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    World::given(gpu(), &words).build(gpu(), &Shape::new(5, dense_level, Filter::Split))
}

fn voxel(q: [i64; 3], albedo: [u32; 3]) -> Fragment {
    Fragment { q, normal: [511, 511, 1022], albedo, coverage: 255 }
}

#[test]
fn nodes_are_the_means_of_their_children() {
    for dense_level in DENSE_LEVELS {
        for count in [1, 50, 4000] {
            let built = build(&random::scene(count as u64, count, 5), dense_level);
            rules::check_nodes(&built).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

#[test]
fn empty_nodes_and_dummies_are_exactly_zero() {
    for dense_level in DENSE_LEVELS {
        let built = build(&random::scene(3, 60, 5), dense_level);
        let leaves = rules::leaves(&built).expect("leaves");
        let mut empty = 0;
        for ((level, cell), index) in rules::walk(&built).expect("walks") {
            let is_above = |leaf: &[u32; 3]| leaf.map(|c| c >> (5 - level)) == cell;
            if !leaves.keys().any(is_above) {
                assert_eq!(built.nodes[index as usize], [0; 4], "node {cell:?} of level {level}");
                empty += 1;
            }
        }
        assert!(empty > 100);
    }
}

#[test]
fn occupied_volume_is_conserved_at_every_level() {
    for dense_level in DENSE_LEVELS {
        let voxels = random::scene(4, 3000, 5);
        let built = build(&voxels, dense_level);
        let shape = Shape::new(5, dense_level, Filter::Split);
        let expected = Expected::new(voxels.into_iter().map(Some).collect(), &shape);
        rules::check_conservation(&built, &expected).unwrap_or_else(|difference| panic!("{difference}"));
    }
}

#[test]
fn a_constant_field_stays_constant_at_any_occupancy() {
    let mut rng = random::rng(5);
    for albedo in [[5, 6, 7], [85, 127, 254], [255, 0, 128]] {
        let voxels: Vec<_> = (0..2000).map(|_| voxel(random::voxel(&mut rng, 5).q, albedo)).collect();
        let built = build(&voxels, 2);
        for words in built.nodes.iter().filter(|words| words[0] | words[1] != 0) {
            let node = rules::node(*words);
            assert_eq!((node.albedo, node.normal), (albedo.map(|a| f64::from(4 * a)), [511.0, 511.0, 1022.0]));
        }
    }
}

#[test]
fn a_full_grid_is_full_up_to_the_root() {
    let voxels: Vec<_> =
        (0..1 << 15).map(|i| voxel([i % 32, i / 32 % 32, i / 1024].map(|c| c * ONE), [40; 3])).collect();
    for dense_level in DENSE_LEVELS {
        let built = build(&voxels, dense_level);
        for ((level, _), index) in rules::walk(&built).expect("walks") {
            assert_eq!(rules::node(built.nodes[index as usize]).occupancy, 1 << (24 + 3 * (5 - level)));
        }
    }
}

#[test]
fn black_but_opaque_is_occupied() {
    let built = build(&[voxel([7 * ONE; 3], [0; 3])], 2);
    assert_eq!(built.leaves[0][..2], [1 << 24, 0]);
    let root = rules::node(built.nodes[0]);
    assert_eq!((root.occupancy, root.albedo), (1 << 24, [0.0; 3]));
    // Black next to white is grey, weighted by how much there is of each: 1020·√¾.
    let quarter = voxel([8 * ONE - ONE / 4, 20 * ONE, 20 * ONE], [0; 3]);
    let white = |x: i64| voxel([x * ONE, 21 * ONE, 20 * ONE], [255; 3]);
    let built = build(&[quarter, white(7), white(8), white(9)], 2);
    let root = rules::node(built.nodes[0]);
    assert_eq!((root.occupancy, root.albedo), (4 << 24, [883.0; 3]));
}

#[test]
fn opposed_surfaces_average_to_a_short_normal() {
    let up = Fragment { q: [2 * ONE; 3], normal: [511, 511, 1022], albedo: [9; 3], coverage: 255 };
    let down = Fragment { q: [20 * ONE; 3], normal: [511, 511, 0], albedo: [9; 3], coverage: 255 };
    let side = Fragment { q: [2 * ONE, 20 * ONE, 2 * ONE], normal: [1022, 511, 511], albedo: [9; 3], coverage: 255 };
    let root = |voxels: &[Fragment]| rules::node(build(voxels, 2).nodes[0]).normal;
    assert_eq!(root(&[up, down]), [511.0; 3]);
    // Each in its own octant, so that the root rounds first: (511 + 511 + 1022) / 3 = 681.33 along x, (1022 + 0 + 511) / 3 = 511 along z.
    assert_eq!(root(&[up, down, side]), [681.0, 511.0, 511.0]);
}

#[test]
fn a_weight_of_one_unit_reaches_the_root() {
    // A corner of 1/256³ of a voxel sticks into the grid; the rest is clipped.
    let q = [1 - ONE; 3];
    let built = build(&[voxel(q, [200, 100, 50])], 0);
    assert_eq!((built.leaves[0][0], built.clipped), (1, (1 << 24) - 1));
    let root = rules::node(built.nodes[0]);
    assert_eq!((root.occupancy, root.albedo), (1, [800.0, 400.0, 200.0]));
    let mut rng = random::rng(6);
    let loud: Vec<_> =
        (0..500).map(|_| voxel([(); 3].map(|()| rng.random_range(8..31)).map(|c| c * ONE), [3; 3])).collect();
    let with: Vec<_> = loud.iter().copied().chain([voxel(q, [200; 3])]).collect();
    let occupancy = |voxels: &[Fragment]| rules::node(build(voxels, 2).nodes[0]).occupancy;
    assert_eq!(occupancy(&with), occupancy(&loud) + 1);
}
