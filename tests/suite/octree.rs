//! The octree: kernels against references, the structure's own rules, the same bits in every build.

use std::sync::LazyLock;

use octolume::data::octree::OctreeParams;
use octolume::gpu::Gpu;
use octolume::settings::Filter;
use octolume::stages::SHADERS;
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::RngExt;

use crate::device::{gpu, open};
use crate::octree_rules as rules;
use crate::random::{self, ONE};
use crate::stage_build::{Built, OctreeBuffers, Shape};
use crate::stage_checks::Expected;
use crate::stage_rig::{World, world_voxel};

const FILTERS: [Filter; 2] = [Filter::Nearest, Filter::Split];

/// Builds and holds every check against what came out.
pub fn build_checked(gpu: &Gpu, voxels: &[Fragment], shape: &Shape) -> Built {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let world = World::given(gpu, &words);
    let built = world.build(gpu, shape);
    let expected = Expected::new(voxels.iter().copied().map(Some).collect(), shape);
    let all = expected
        .check(&built)
        .and_then(|()| rules::validate(&built))
        .and_then(|()| rules::check_conservation(&built, &expected))
        .and_then(|()| rules::check_interpolation_corners(&built));
    all.unwrap_or_else(|difference| panic!("{} voxels, {shape:?}: {difference}", voxels.len()));
    built
}

pub fn aligned(cell: [i64; 3]) -> Fragment {
    Fragment { q: cell.map(|c| c * ONE), normal: [511, 511, 1022], albedo: [200, 100, 50], coverage: 255 }
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
        let root = rules::node(built.nodes[0]);
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
fn no_kernel_of_the_build_waits_for_another_thread() {
    let is_built =
        |path: &str| ["build/", "fill/", "average/", "shared/"].iter().any(|folder| path.starts_with(folder));
    for (path, text) in SHADERS.files.iter().filter(|(path, _)| is_built(path)) {
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
    rules::validate(&built).expect("valid");
    let found = rules::leaves(&built).expect("leaves");
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), [[0, last as u32, 1], [last as u32; 3]]);
    // Two full leaves of 2^27: nothing narrower than 64 bits of occupancy would see them.
    assert_eq!(rules::node(built.nodes[0]).occupancy, 2 << 24);
    assert_eq!(built.params.dense_node_count, OctreeParams::new(depth, 6).dense_node_count);
}
