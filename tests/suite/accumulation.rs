//! What several voxels leave in one cell: exact integer sums, in any order, however many.

use octolume::data::albedo::{code_of, units_of};
use octolume::data::octree::{FULL_WEIGHT, MAX_FRAGMENTS};
use octolume::settings::Filter;
use octolume::stages::fill::gather_ref::{Fragment, Leaf, sums};
use proptest::prelude::*;

use crate::device::gpu;
use crate::octree_rules as rules;
use crate::random::{self, ONE};
use crate::stage_build::{Built, Shape};
use crate::stage_checks::Expected;
use crate::stage_rig::{World, world_voxel};

const FILTERS: [Filter; 2] = [Filter::Nearest, Filter::Split];

/// 8³ cells are enough for what happens in one.
fn small(filter: Filter) -> Shape {
    Shape::new(3, 0, filter)
}

fn build(voxels: &[Fragment], shape: &Shape) -> Built {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    World::given(gpu(), &words).build(gpu(), shape)
}

fn built_leaves(voxels: &[Fragment], shape: &Shape) -> std::collections::BTreeMap<[u32; 3], Leaf> {
    rules::leaves(&build(voxels, shape)).unwrap_or_else(|difference| panic!("{difference}"))
}

fn assert_equals_reference(voxels: &[Fragment], shape: &Shape) {
    let built = build(voxels, shape);
    let expected = Expected::new(voxels.iter().copied().map(Some).collect(), shape);
    let all = expected
        .check(&built)
        .and_then(|()| rules::validate(&built))
        .and_then(|()| rules::check_conservation(&built, &expected));
    all.unwrap_or_else(|difference| panic!("{} voxels, {shape:?}: {difference}", voxels.len()));
}

fn at(cell: [i64; 3], albedo: [u32; 3], normal: [u32; 3]) -> Fragment {
    Fragment { q: cell.map(|c| c * ONE), normal, albedo, coverage: 255 }
}

/// Fisher and Yates.
fn shuffle(voxels: &mut [Fragment], rng: &mut impl RngExt) {
    for last in (1..voxels.len()).rev() {
        voxels.swap(last, rng.random_range(0..=last));
    }
}

#[test]
fn a_hundred_shuffles_give_identical_bits() {
    let mut rng = random::rng(1);
    // Crowded enough that some blocks are heavy.
    let mut voxels = random::scene(1, 1800, 2);
    for filter in FILTERS {
        let shape = Shape::new(2, 0, filter);
        let first = build(&voxels, &shape);
        assert_eq!(!first.heavy_blocks.is_empty(), filter == Filter::Split);
        for _ in 0..50 {
            shuffle(&mut voxels, &mut rng);
            let again = build(&voxels, &shape);
            assert!(again.leaves == first.leaves && again.nodes == first.nodes && again.leaf_bits == first.leaf_bits);
        }
    }
}

#[test]
fn a_million_fragments_in_one_cell_are_summed_exactly() {
    let mut rng = random::rng(2);
    let shape = small(Filter::Split);
    let mut voxel = || {
        let q = [3, 2, 5].map(|cell| rng.random_range(cell * ONE..(cell + 1) * ONE));
        Fragment {
            q,
            normal: [1022, rng.random_range(0..=1022), 0],
            albedo: [255, rng.random_range(0..=255), 1],
            coverage: 255,
        }
    };
    let voxels: Vec<Fragment> = (0..1_000_000).map(|_| voxel()).collect();
    let sums = sums(voxels.iter().copied(), shape.depth, shape.filter);
    assert_eq!(sums.len(), 8);
    let found = built_leaves(&voxels, &shape);
    for (cell, sum) in sums {
        assert!(sum.weight > 100_000 << 24, "far beyond 32 bits");
        assert_eq!(found[&cell], sum.resolve());
        // Extremes come out as they went in: nothing wrapped.
        assert_eq!((found[&cell].albedo[0], found[&cell].normal[0], found[&cell].normal[2]), (1020, 1022, 0));
    }
}

#[test]
fn a_million_full_voxels_in_one_cell_keep_their_mean() {
    for filter in FILTERS {
        let voxels: Vec<_> = (0..1_000_000_u32)
            .map(|i| if i % 4 == 0 { at([4; 3], [255; 3], [1022; 3]) } else { at([4; 3], [0; 3], [0; 3]) })
            .collect();
        let built = build(&voxels, &small(filter));
        let found = rules::leaves(&built).expect("leaves");
        // A quarter of white has half its root, 510 of 1020; 1022/4 = 255.5.
        assert_eq!(found[&[4; 3]], Leaf { occupancy: FULL_WEIGHT, albedo: [510; 3], normal: [256; 3] });
        assert_eq!((found.len(), built.clipped), (1, 0));
    }
}

#[test]
fn the_limits_of_one_thread_are_exact_on_both_sides() {
    let bound = MAX_FRAGMENTS as usize;
    for count in [1, 2, bound - 1, bound, bound + 1, bound + 63, 2 * bound + 65] {
        for filter in FILTERS {
            let white: Vec<_> = vec![at([4; 3], [255; 3], [1022; 3]); count];
            let built = build(&white, &small(filter));
            assert_eq!(
                built.leaves,
                [[FULL_WEIGHT, 1020 * (1 | 1 << 10 | 1 << 20), 1022 * (1 | 1 << 10 | 1 << 20)]],
                "{count}"
            );
            assert_eq!(built.heavy_blocks.is_empty(), count <= bound);
        }
        assert_equals_reference(&random::scene(count as u64, count, 2), &Shape::new(2, 0, Filter::Split));
    }
}

#[test]
fn equal_inputs_give_that_value_however_many() {
    for count in [1, 2, 64, 512, 2048, 5000] {
        for byte in [0, 1, 26, 127, 140, 254, 255] {
            let normal = [byte, 1022 - byte, 511];
            let mut rng = random::rng(u64::from(byte));
            let voxel = |rng: &mut _| Fragment {
                q: random::voxel(rng, 1).q,
                normal,
                albedo: [byte, 255 - byte, 13],
                coverage: 255,
            };
            let voxels: Vec<_> = (0..count).map(|_| voxel(&mut rng)).collect();
            let built = build(&voxels, &Shape::new(1, 0, Filter::Split));
            let leaves = rules::leaves(&built).expect("leaves");
            let albedo = [byte, 255 - byte, 13].map(|code| code_of(units_of(code)));
            assert!(leaves.values().all(|leaf| leaf.albedo == albedo && leaf.normal == normal));
            let root = rules::node(built.nodes[0]);
            assert_eq!(root.albedo, albedo.map(f64::from));
            assert_eq!(root.normal, normal.map(f64::from));
        }
    }
}

#[test]
fn a_corner_of_weight_zero_has_no_leaf_and_changes_none() {
    // On the lattice along some axes: 2^n leaves for n axes off it.
    for off in 0..8_i64 {
        let steps = [off & 1, off >> 1 & 1, off >> 2 & 1];
        let q = [0, 1, 2].map(|axis| 3 * ONE + 77 * steps[axis]);
        let neighbour = at([4; 3], [200; 3], [511; 3]);
        let found = built_leaves(
            &[Fragment { q, normal: [511; 3], albedo: [10; 3], coverage: 255 }, neighbour],
            &small(Filter::Split),
        );
        let expected = (1 << off.count_ones()) + usize::from(off != 7);
        assert_eq!(found.len(), expected, "{steps:?}");
        assert_eq!(found[&[4; 3]].albedo == [800; 3], off != 7);
    }
    assert!(built_leaves(&[], &small(Filter::Split)).is_empty());
}

#[test]
fn opposed_normals_are_flagged_by_zero_length() {
    for count in [1, 200, 3000] {
        let pair = [at([2; 3], [8; 3], [1022, 511, 300]), at([2; 3], [8; 3], [0, 511, 722])];
        let voxels: Vec<_> = pair.iter().copied().cycle().take(2 * count).collect();
        for filter in FILTERS {
            let built = build(&voxels, &small(filter));
            let leaf = rules::leaves(&built).expect("leaves")[&[2; 3]];
            assert_eq!((leaf.normal, leaf.albedo, leaf.occupancy), ([511; 3], [32; 3], FULL_WEIGHT));
            assert_eq!(rules::node(built.nodes[0]).normal, [511.0; 3]);
        }
    }
}

#[test]
fn sums_are_taken_before_occupancy_is_clamped_and_the_excess_is_known() {
    // Three full voxels and a half one: 3.5 voxels in a leaf that holds one.
    let half = Fragment { q: [ONE + ONE / 2, ONE, ONE], normal: [511; 3], albedo: [255; 3], coverage: 255 };
    let voxels = [at([1; 3], [0; 3], [511; 3]), at([1; 3], [0; 3], [511; 3]), at([1; 3], [0; 3], [511; 3]), half];
    let built = build(&voxels, &small(Filter::Split));
    let found = rules::leaves(&built).expect("leaves");
    // White is a seventh: 1020·√(1/7) = 385.5, of rounded units 385; weights after clamping would give a third.
    assert_eq!(found[&[1; 3]], Leaf { occupancy: FULL_WEIGHT, albedo: [385; 3], normal: [511; 3] });
    assert_eq!(found[&[2, 1, 1]], Leaf { occupancy: FULL_WEIGHT / 2, albedo: [1020; 3], normal: [511; 3] });
    // Excess = total − clipped − what the root holds.
    let root = rules::node(built.nodes[0]).occupancy as u64;
    let excess = (4 << 24) - built.clipped - root;
    assert_eq!(excess, (5 << 24) / 2);
}

#[test]
fn a_leaf_one_unit_short_of_full_is_not_full() {
    // In cell 0: 255·256·256, 255·256·1 and 255·1·1 units, together 2^24 − 1; then the last one.
    let rest = [[1, 0, 0], [1, 0, 255], [1, 255, 255], [255, 255, 255]];
    let voxels = rest.map(|q| Fragment { q, normal: [511; 3], albedo: [77; 3], coverage: 255 });
    let occupancy = |voxels: &[Fragment]| built_leaves(voxels, &small(Filter::Split))[&[0; 3]].occupancy;
    assert_eq!(occupancy(&voxels[..3]), FULL_WEIGHT - 1);
    assert_eq!(occupancy(&voxels), FULL_WEIGHT);
}

#[test]
fn halves_round_up_and_just_below_a_half_rounds_down() {
    let mix = |dark: usize, light: usize| {
        let mut voxels = vec![at([4; 3], [0; 3], [600; 3]); dark];
        voxels.extend(vec![at([4; 3], [2; 3], [601; 3]); light]);
        built_leaves(&voxels, &small(Filter::Split))[&[4; 3]]
    };
    for (dark, light, up) in [(1, 1, 1), (512, 512, 1), (513, 511, 0), (511, 513, 1), (2000, 2000, 1), (2001, 1999, 0)]
    {
        let leaf = mix(dark, light);
        assert_eq!((leaf.albedo, leaf.normal), ([8 * up; 3], [600 + up; 3]), "{dark} and {light}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, max_shrink_iters: 8, ..ProptestConfig::default() })]

    #[test]
    fn any_crowd_equals_the_reference(seed in any::<u64>(), count in 1..2500_usize, depth in 1..4_u32) {
        for filter in FILTERS {
            assert_equals_reference(&random::scene(seed, count, depth), &Shape::new(depth, 0, filter));
        }
    }
}
