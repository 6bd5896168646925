//! Sizes that only the GPU knows: predictions bound them, and what outgrows its prediction writes nothing.

use std::collections::BTreeSet;

use octolume::data::light::light_bytes;
use octolume::data::octree::{OctreeParams, PointerLayout};
use octolume::settings::Filter;
use octolume::stages::build::size_ref;
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::*;

use crate::device::gpu;
use crate::random;
use crate::stage_build::{Built, OctreeBuffers, Shape};
use crate::stage_rig::{World, world_voxel};

const DEPTH: u32 = 6;

fn world(voxels: &[Fragment]) -> World {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    World::given(gpu(), &words)
}

/// Sizes from the number of blocks of each level from the dense one on.
fn params(depth: u32, blocks: &[u32], leaves: u32) -> OctreeParams {
    let mut firsts = vec![0];
    for count in blocks {
        firsts.push(firsts[firsts.len() - 1] + count);
    }
    OctreeParams::new(depth, depth - blocks.len() as u32).with_counts(&firsts, leaves)
}

fn blocks(sizes: &OctreeParams) -> Vec<u32> {
    (sizes.dense_level..sizes.depth).map(|level| sizes.block_count_of(level)).collect()
}

/// Room for so much less of each level, and of leaves.
fn short_of(exact: &OctreeParams, level: u32, missing: u32) -> OctreeParams {
    let mut counts = blocks(exact);
    let mut leaves = exact.leaf_count;
    match counts.get_mut((level - exact.dense_level) as usize) {
        Some(count) => *count -= missing,
        None => leaves -= missing,
    }
    params(exact.depth, &counts, leaves)
}

/// What the voxels' order inside a block leaves open is put in order.
fn ordered(mut built: Built) -> Built {
    let inside: Vec<_> = built.block_starts.windows(2).map(|pair| pair[0][0] as usize..pair[1][0] as usize).collect();
    inside.iter().for_each(|range| built.sorted_voxels[range.clone()].sort_unstable());
    let sorted = built.block_starts.last().map_or(0, |end| end[0] as usize);
    built.sorted_voxels.truncate(sorted);
    built.places.iter_mut().for_each(|place| place[1] = 0);
    built.heavy_blocks.sort_unstable();
    built
}

fn crowded(seed: u64) -> Vec<Fragment> {
    let mut voxels = random::scene(seed, 3000, DEPTH);
    // Too many for one thread.
    let q = [20, 21, 22].map(|cell| cell * random::ONE + 7);
    voxels.extend(std::iter::repeat_n(Fragment { q, normal: [511, 511, 1022], albedo: [9; 3], coverage: 255 }, 1500));
    voxels
}

#[test]
fn a_build_with_room_equals_one_that_knows_its_sizes() {
    for (filter, dense_level) in [(Filter::Split, 3), (Filter::Nearest, 0), (Filter::Split, DEPTH - 1)] {
        let (world, shape) = (world(&crowded(1)), Shape::new(DEPTH, dense_level, filter));
        let exact = world.build(gpu(), &shape);
        assert!(!exact.heavy_blocks.is_empty());
        let mut buffers = OctreeBuffers::default();
        for room in [exact.params, exact.params.with_room(), exact.params.with_room().with_room()] {
            let built = world.build_within(gpu(), &shape, &room, &mut buffers);
            assert_eq!(built.params, exact.params);
            assert!(ordered(built) == ordered(exact.clone()), "{filter:?}, dense level {dense_level}");
        }
    }
}

#[test]
fn sizes_are_the_references() {
    let shape = Shape::new(DEPTH, 2, Filter::Split);
    let world = world(&random::scene(2, 700, DEPTH));
    let exact = world.build(gpu(), &shape).params;
    let rooms = (2..=DEPTH).map(|level| short_of(&exact, level, 1));
    for room in rooms.chain([exact, exact.with_room()]) {
        let found = world.build_within(gpu(), &shape, &room, &mut OctreeBuffers::default()).params;
        let expected = size_ref::size(&blocks(&exact), exact.leaf_count, &room);
        assert_eq!(found, expected, "{room:?}");
        assert_eq!(exact.fits(&room), found == exact);
    }
}

#[test]
fn without_room_nothing_behind_the_masks_is_written() {
    let shape = Shape::new(DEPTH, 2, Filter::Split);
    let world = world(&crowded(3));
    let exact = world.build(gpu(), &shape).params;
    for level in 2..=DEPTH {
        let mut buffers = OctreeBuffers::default();
        let room = short_of(&exact, level, 1);
        let built = world.build_within(gpu(), &shape, &room, &mut buffers);
        assert_eq!((built.params.block_count, built.params.leaf_count), (0, 0));
        assert!(built.places.iter().all(|place| place[0] == u32::MAX));
        let (t, p) = (&buffers.topology, &buffers.payload);
        let untouched = [&t.block_keys, &t.block_counts, &p.sorted_voxels, &p.leaves];
        for slot in untouched {
            let buffer = slot.made("a buffer").expect("made");
            let words: Vec<u32> = gpu().read(&buffer, 0..buffer.bytes()).expect("readable");
            assert!(words.iter().all(|word| *word == u32::MAX), "{}", buffer.label());
        }
        for slot in [&t.first_child, &p.nodes, &buffers.leaf_objects] {
            let buffer = slot.made("a buffer").expect("made");
            let words: Vec<u32> = gpu().read(&buffer, 0..buffer.bytes()).expect("readable");
            assert!(words.iter().all(|word| *word == 0), "{} was cleared, and is written", buffer.label());
        }
        // The same buffers take the octree once there is room.
        let again = world.build_within(gpu(), &shape, &exact.with_room(), &mut buffers);
        assert!(ordered(again) == ordered(world.build(gpu(), &shape)));
    }
}

#[test]
fn an_empty_octree_fits_any_room() {
    let shape = Shape::new(DEPTH, 2, Filter::Split);
    let known = OctreeParams::new(DEPTH, 2);
    let empty = known.with_counts(&[0; 5], 0);
    let built = world(&[]).build_within(gpu(), &shape, &empty, &mut OctreeBuffers::default());
    assert_eq!(built.params, empty);
    assert!(empty.fits(&empty) && empty.fits(&empty.with_room()));
    assert!(built.nodes.iter().all(|node| *node == [0; 4]));
}

#[test]
fn a_topology_serves_again_when_its_payload_is_made_anew() {
    let shape = Shape::new(DEPTH, 3, Filter::Split);
    let (world, mut buffers) = (world(&random::scene(4, 900, DEPTH)), OctreeBuffers::default());
    let built = world.build_in(gpu(), &shape, &mut buffers);
    let counts = buffers.topology.block_counts.made("block counts").expect("made");
    let kept: Vec<[u32; 2]> = gpu().read(&counts, 0..8 * built.block_counts.len() as u64).expect("readable");
    let leaves: Vec<u32> = built.block_counts.iter().map(|counts| counts[1]).collect();
    assert_eq!(kept, leaves.iter().map(|count| [0, *count]).collect::<Vec<_>>());
}

/// Depth, and sizes that an octree of it may have.
fn any_sizes() -> impl Strategy<Value = OctreeParams> {
    (1_u32..=10).prop_flat_map(|depth| (Just(depth), 0..depth)).prop_flat_map(|(depth, dense)| {
        let counts: Vec<_> = (dense..depth).map(|level| 0..=(1_u32 << (3 * level)).min(1 << 24)).collect();
        (counts, 0..=(1_u32 << (3 * depth)).min(1 << 28))
            .prop_map(move |(counts, leaves)| params(depth, &counts, leaves))
    })
}

proptest! {
    #[test]
    fn a_prediction_bounds_what_it_was_made_from(exact in any_sizes()) {
        let room = exact.with_room();
        prop_assert!(exact.fits(&room) && exact.fits(&exact));
        let names = BTreeSet::from([exact, room].map(|p| (p.depth, p.dense_level, p.dense_node_count)));
        prop_assert_eq!(names.len(), 1);
        for level in 0..=exact.depth {
            prop_assert!(room.node_count(level) >= exact.node_count(level));
            let word = |p: &OctreeParams| (p.levels[level as usize].blocks_word, p.levels[level as usize].occupied_word);
            prop_assert_eq!(word(&room), word(&exact));
        }
        for level in exact.dense_level..exact.depth {
            prop_assert!(room.block_count_of(level) >= exact.block_count_of(level));
            prop_assert!(room.block_count_of(level) <= 1 << (3 * level));
        }
        let totals = |p: &OctreeParams| [p.block_count, p.leaf_block_count, p.inner_node_count, p.leaf_count];
        prop_assert!(totals(&room).iter().zip(totals(&exact)).all(|(room, exact)| *room >= exact));
        for layout in [PointerLayout::Blocks, PointerLayout::Nodes] {
            prop_assert!(layout.words(&room) >= layout.words(&exact));
        }
        for is_directional in [false, true] {
            prop_assert!(light_bytes(&room, is_directional) >= light_bytes(&exact, is_directional));
        }
        let counted: u32 = (0..exact.depth).map(|level| room.node_count(level)).sum();
        prop_assert_eq!(counted, room.inner_node_count);
    }

    #[test]
    fn less_room_anywhere_is_too_little(exact in any_sizes(), at in 0_u32..11) {
        let level = exact.dense_level + at % (exact.depth - exact.dense_level + 1);
        let count = if level < exact.depth { exact.block_count_of(level) } else { exact.leaf_count };
        prop_assume!(count > 0);
        prop_assert!(!exact.fits(&short_of(&exact, level, 1)));
    }
}
