//! The octree: kernels against references, the structure's own rules, dummies.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use octolume::data::octree::{OctreeBuffers, OctreeParams};
use octolume::gpu::Gpu;
use octolume::gpu::shaders::FILES;
use octolume::settings::Filter;
use octolume::stages::build::reduce_ref;
use octolume::stages::build::scan::{self, Scanned};
use octolume::stages::build::{scan_spread_ref, scan_sum, scan_sum_ref};
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;

use crate::device::{gpu, open};
use crate::random::{self, ONE};
use crate::stage_checks::{self as checks, Expected};
use crate::stage_rig::{Built, Shape, World, buffer, read, run, upload, world_voxel};

const FILTERS: [Filter; 2] = [Filter::Nearest, Filter::Split];

/// Builds and holds every check against what came out.
fn build_checked(gpu: &Gpu, voxels: &[Fragment], shape: &Shape) -> Built {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let world = World::given(gpu, &words);
    let built = world.build(gpu, shape);
    let expected = Expected::new(voxels.iter().copied().map(Some).collect(), shape);
    let all = expected
        .check(&built)
        .and_then(|()| checks::validate(&built))
        .and_then(|()| checks::check_conservation(&built, &expected))
        .and_then(|()| checks::check_interpolation_corners(&built));
    all.unwrap_or_else(|difference| panic!("{} voxels, {shape:?}: {difference}", voxels.len()));
    built
}

fn aligned(cell: [i64; 3]) -> Fragment {
    Fragment { q: cell.map(|c| c * ONE), normal: [511, 511, 1022], albedo: [200, 100, 50] }
}

#[test]
fn random_sets_agree_with_the_reference() {
    for filter in FILTERS {
        for dense_level in [0, 3, 5] {
            let voxels = random::scene(u64::from(dense_level), 1500, 6);
            build_checked(gpu(), &voxels, &Shape::new(6, dense_level, filter));
        }
    }
}

#[test]
fn small_trees_agree_with_the_reference_at_every_dense_level() {
    for depth in 1..=4 {
        for dense_level in 0..depth {
            for (filter, count) in [(Filter::Split, 3), (Filter::Nearest, 40), (Filter::Split, 300)] {
                let voxels = random::scene(u64::from(depth * 8 + dense_level), count, depth);
                build_checked(gpu(), &voxels, &Shape::new(depth, dense_level, filter));
            }
        }
    }
}

#[test]
fn an_empty_grid_has_its_dense_nodes_and_nothing_else() {
    for filter in FILTERS {
        for dense_level in [0, 3, 5] {
            let built = build_checked(gpu(), &[], &Shape::new(6, dense_level, filter));
            assert_eq!((built.params.block_count, built.params.leaf_count), (0, 0));
            assert!(built.nodes.iter().all(|node| *node == [0; 4]));
        }
    }
}

#[test]
fn one_voxel_has_one_path_and_its_dummies() {
    for dense_level in [0, 3, 5] {
        let built = build_checked(gpu(), &[aligned([33, 33, 33])], &Shape::new(6, dense_level, Filter::Split));
        assert_eq!(built.params.leaf_count, 1);
        // Leaf 33 and its dummy 32 share block 16; node 16 asks for 15, which is in block 7 of level 4;
        // node 8 of level 4 asks for 7, block 3 of level 3; 4 for 3, block 1 of level 2; 2 for 1, block 0
        // of level 1; 1 for 0, in the same block.
        let blocks: Vec<u32> = (0..6).map(|level| built_blocks(&built, level)).collect();
        assert_eq!(blocks[dense_level as usize..], [1, 8, 8, 8, 8, 1][dense_level as usize..]);
    }
}

fn built_blocks(built: &Built, level: u32) -> u32 {
    if level < built.params.dense_level { 0 } else { built.params.block_count_of(level) }
}

#[test]
fn the_eight_corners_of_the_grid() {
    for dense_level in [0, 3, 5] {
        let corners: Vec<_> = (0..8).map(|c| aligned([c & 1, c >> 1 & 1, c >> 2 & 1].map(|bit| 63 * bit))).collect();
        let built = build_checked(gpu(), &corners, &Shape::new(6, dense_level, Filter::Split));
        assert_eq!(built.params.leaf_count, 8);
        // 63 shares its block with its dummy 62 at the leaves; higher up, node 2^l − 1 does too.
        let root = checks::node(built.nodes[0]);
        assert_eq!(root.occupancy, 8 << 24);
        assert_eq!((root.albedo, root.normal), ([800.0, 400.0, 200.0], [511.0, 511.0, 1022.0]));
        if dense_level == 5 {
            assert_eq!(built.params.block_count, 8);
        }
    }
}

#[test]
fn a_full_block_and_a_full_grid() {
    let block: Vec<_> = (0..8).map(|c| aligned([c & 1, c >> 1 & 1, c >> 2 & 1].map(|bit| 20 + bit))).collect();
    let built = build_checked(gpu(), &block, &Shape::new(6, 3, Filter::Split));
    assert_eq!(built.block_counts.iter().filter(|counts| counts[1] == 8).count(), 1);
    let all: Vec<_> = (0..512).map(|i| aligned([i % 8, i / 8 % 8, i / 64])).collect();
    for dense_level in 0..3 {
        let built = build_checked(gpu(), &all, &Shape::new(3, dense_level, Filter::Nearest));
        assert_eq!(built.params.inner_node_count, 1 + 8 + 64);
        assert!(built.leaves.iter().all(|leaf| leaf[0] == 1 << 24));
    }
}

#[test]
fn no_dummy_outside_the_grid_and_none_wraps_a_row() {
    for cell in [[0, 32, 32], [32, 0, 32], [32, 32, 0], [0, 0, 0], [0, 0, 63]] {
        let built = build_checked(gpu(), &[aligned(cell)], &Shape::new(6, 0, Filter::Split));
        for level in 0..6 {
            let near = |node: &[u32; 3]| {
                (0..3).all(|axis| (cell[axis] >> (6 - level)) - i64::from(node[axis]) <= 1)
                    && (0..3).all(|axis| i64::from(node[axis]) <= cell[axis] >> (6 - level))
            };
            let allocated = checks::allocated_cells(&built, level);
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
            let found = checks::allocated_cells(&built, level);
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
        assert_eq!(checks::leaves(&with), checks::leaves(&without));
        let (index_with, index_without) = (checks::walk(&with).expect("walks"), checks::walk(&without).expect("walks"));
        for (key, index) in &index_with {
            let bare = index_without.get(key).map_or([0; 4], |index| without.nodes[*index as usize]);
            assert_eq!(with.nodes[*index as usize], bare, "node {key:?}");
        }
    }
}

/// What may differ between builds of the same voxels: the order inside a block and in the heavy list.
fn normalised(mut built: Built) -> Built {
    built.places.clear();
    built.sorted_voxels.clear();
    built.heavy_blocks.sort_unstable();
    built
}

#[test]
fn two_builds_are_identical() {
    let words: Vec<_> = random::scene(5, 3000, 6).iter().map(world_voxel).collect();
    let shape = Shape::new(6, 3, Filter::Split);
    let world = World::given(gpu(), &words);
    let first = normalised(world.build(gpu(), &shape));
    for _ in 0..3 {
        assert!(normalised(world.build(gpu(), &shape)) == first);
    }
}

#[test]
fn every_workgroup_size_gives_the_same_bits() {
    static OTHERS: LazyLock<[Gpu; 3]> = LazyLock::new(|| [32, 128, 256].map(|size| open().with_workgroup_size(size)));
    // A crowd in one block as well, so that the heavy path runs.
    let mut voxels = random::scene(6, 3000, 6);
    let mut rng = random::rng(66);
    let crowd = (0..4000).map(|_| {
        let q = [(); 3].map(|()| rng.random_range(10 * ONE..12 * ONE));
        random::with_q(&mut rng, q)
    });
    voxels.extend(crowd);
    for filter in FILTERS {
        let shape = Shape::new(6, 3, filter);
        let expected = normalised(build_checked(gpu(), &voxels, &shape));
        assert!(!expected.heavy_blocks.is_empty());
        for other in OTHERS.iter() {
            assert!(normalised(build_checked(other, &voxels, &shape)) == expected);
        }
    }
}

#[test]
fn used_buffers_leave_no_trace() {
    let (a, empty) = (random::scene(7, 2000, 6), Vec::new());
    let b = random::scene(8, 500, 6);
    for filter in FILTERS {
        let shape = Shape::new(6, 3, filter);
        let mut buffers = OctreeBuffers::default();
        let mut build = |voxels: &[Fragment]| {
            let words: Vec<_> = voxels.iter().map(world_voxel).collect();
            normalised(World::given(gpu(), &words).build_in(gpu(), &shape, &mut buffers))
        };
        let first = build(&a);
        let between = [build(&empty), build(&b)];
        assert!(build(&a) == first, "A, empty, B, A");
        assert_eq!(between[0].params.block_count, 0);
        assert!(between[1] == normalised(build_checked(gpu(), &b, &shape)));
    }
}

#[test]
fn a_build_that_needs_more_than_its_buffers_hold_equals_one_in_large_buffers() {
    let shape = Shape::new(6, 3, Filter::Split);
    let [small, large] = [100, 4000].map(|count| {
        let words: Vec<_> = random::scene(10, count, 6).iter().map(world_voxel).collect();
        World::given(gpu(), &words)
    });
    let mut buffers = OctreeBuffers::default();
    small.build_in(gpu(), &shape, &mut buffers);
    let grown = normalised(large.build_in(gpu(), &shape, &mut buffers));
    assert!(grown == normalised(large.build(gpu(), &shape)));
    let small_in_large = normalised(small.build_in(gpu(), &shape, &mut buffers));
    assert!(small_in_large == normalised(small.build(gpu(), &shape)));
}

#[test]
fn scans_of_any_length_are_prefix_sums() {
    let mut rng = random::rng(11);
    for count in [0, 1, 63, 64, 65, 4096, 4097, 300_001] {
        let words: Vec<u32> = (0..2 * count).map(|_| rng.random_range(0..6000)).collect();
        let bits: Vec<u32> = (0..count).map(|_| rng.random_range(0..=u32::MAX)).collect();
        let scanned = |scanned: Scanned, values: &[u32]| -> Vec<u64> {
            let entries = u64::from(scanned.channels()) * (count as u64 + 1);
            let (from, to) = (upload(gpu(), "values", values), buffer(gpu(), "prefixes", entries));
            run(gpu(), |frame| {
                scan::record(gpu(), frame, (scanned, count as u32), &from, &to, &mut Vec::new()).expect("fits");
            });
            read::<u32>(gpu(), &to, entries).into_iter().map(u64::from).collect()
        };
        let channel =
            |values: &[u32], channel: usize| values.iter().copied().skip(channel).step_by(2).collect::<Vec<_>>();
        let pairs = scanned(Scanned::Pairs, &words);
        for c in 0..2 {
            let found: Vec<u64> = pairs.iter().copied().skip(c).step_by(2).collect();
            assert!(found == scan_spread_ref::prefixes(&channel(&words, c)), "{count} pairs");
        }
        let ones: Vec<u32> = bits.iter().map(|word| word.count_ones()).collect();
        assert!(scanned(Scanned::Bits, &bits) == scan_spread_ref::prefixes(&ones), "{count} words of bits");
    }
}

#[test]
fn chunk_sums_are_sums_of_chunks() {
    let values: Vec<u32> = (0..1000).collect();
    let (from, to) = (upload(gpu(), "values", &values), buffer(gpu(), "sums", 16));
    let constants = Scanned::Pairs.constants(true);
    run(gpu(), |frame| scan_sum::record(gpu(), frame, constants, 500, &from, &to));
    let found: Vec<u64> = read::<u32>(gpu(), &to, 16).into_iter().map(u64::from).collect();
    for channel in 0..2 {
        let of_channel: Vec<u32> = values.iter().copied().skip(channel).step_by(2).collect();
        let sums: Vec<u64> = found.iter().copied().skip(channel).step_by(2).collect();
        assert_eq!(sums, scan_sum_ref::chunk_sums(&of_channel, 64));
    }
    // In closed form: the first 64 even numbers.
    assert_eq!(found[0], 63 * 64);
}

#[test]
fn no_kernel_of_the_build_waits_for_another_thread() {
    let is_built =
        |path: &str| ["build/", "fill/", "average/", "shared/"].iter().any(|folder| path.starts_with(folder));
    for (path, text) in FILES.iter().filter(|(path, _)| is_built(path)) {
        assert!(!text.contains("atomicCompareExchange"), "{path} takes a lock");
        for line in text.lines().filter(|line| line.trim_start().starts_with("while") || line.contains("loop")) {
            assert!(!line.contains("atomic"), "{path} waits: {line}");
        }
    }
}

#[test]
fn the_deepest_grid_keeps_its_last_cell() {
    let depth = 9;
    let last = (1 << depth) - 1;
    let voxels = [aligned([last; 3]), aligned([0, last, 1])];
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let built = World::given(gpu(), &words).build(gpu(), &Shape::new(depth, 6, Filter::Split));
    checks::validate(&built).expect("valid");
    let found = checks::leaves(&built).expect("leaves");
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), [[0, last as u32, 1], [last as u32; 3]]);
    // Two full leaves of 2^27: nothing narrower than 64 bits of occupancy would see them.
    assert_eq!(checks::node(built.nodes[0]).occupancy, 2 << 24);
    assert_eq!(built.params.dense_node_count, OctreeParams::new(depth, 6).dense_node_count);
}
