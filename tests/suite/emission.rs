//! Emission from caches to leaves: kernels against references, order-free to the bit.

use glam::DVec3;
use octolume::data::light::{EMISSION_MAX, EmissionBuffers, pack_emission};
use octolume::settings::Filter;
use octolume::stages::fill::gather_emission_ref;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::fill::place_emission::{self, Emission};
use octolume::stages::fill::{Filling, gather_emission, place_emission_ref};
use octolume::stages::transform::PartRecord;
use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::light_rig::full;
use crate::octree_rules as rules;
use crate::random;
use crate::stage_build::{Built, OctreeBuffers, Shape};
use crate::stage_rig::{World, read, run, upload, world_voxel};

fn unpacked([low, high]: [u32; 2]) -> [u32; 3] {
    let bits = u64::from(low) | u64::from(high) << 32;
    // Green lies across the words: 12 bits below, 8 above; blue begins at bit 40.
    [0, 20, 40].map(|shift| (bits >> shift & u64::from(EMISSION_MAX)) as u32)
}

#[test]
fn packing_keeps_twenty_bits_a_channel() {
    assert_eq!(unpacked(pack_emission([2.0, 1.0, 0.0], 2.0)), [EMISSION_MAX, EMISSION_MAX.div_ceil(2), 0]);
    assert_eq!(unpacked(pack_emission([0.0, 2.0 / EMISSION_MAX as f32, 2.0], 2.0)), [0, 1, EMISSION_MAX]);
}

struct Gathered {
    built: Built,
    sorted: Vec<[u32; 3]>,
    emits: Vec<u32>,
    leaves: Vec<[f32; 3]>,
}

fn gathered(voxels: &[Fragment], emission: &[[u32; 2]], filter: Filter) -> Gathered {
    let words: Vec<_> = voxels.iter().map(world_voxel).collect();
    let mut world = World::given(gpu(), &words);
    world.listed.parts = upload(gpu(), "parts", &[PartRecord { emission_skew: 0, ..PartRecord::default() }]);
    let mut buffers = OctreeBuffers::default();
    let built = world.build_in(gpu(), &Shape::new(5, 3, filter), &mut buffers);
    let fill = Filling::made(buffers.octree()).expect("built");
    let cache_emission = upload(gpu(), "cache emission", emission);
    let (mut light, sizes) = (EmissionBuffers::default(), buffers.octree().sizes);
    let emission = Emission::new(gpu(), &mut light, sizes, (cache_emission, world.list.threads)).expect("fits");
    run(gpu(), |frame| {
        place_emission::record(gpu(), frame, &world.listed, sizes, &fill, &emission);
        gather_emission::record(gpu(), frame, sizes, filter, &fill, &emission);
    });
    let inside = built.places.iter().filter(|place| place[0] != u32::MAX).count() as u64;
    let sorted: Vec<[u32; 2]> = read(gpu(), &emission.sorted_emission, inside);
    Gathered {
        sorted: sorted.into_iter().map(unpacked).collect(),
        emits: read(gpu(), &emission.emitting_blocks, built.params.leaf_block_count.into()),
        leaves: read(gpu(), &emission.leaf_emission, built.params.leaf_count.into()),
        built,
    }
}

/// A third of the voxels emit.
fn scene(seed: u64, count: usize) -> (Vec<Fragment>, Vec<[u32; 2]>) {
    let mut rng = random::rng(seed);
    let mut some = || {
        let emits = rng.random_range(0..3) == 0;
        pack_emission([(); 3].map(|()| if emits { rng.random_range(0.0..1.0) } else { 0.0 }), 1.0)
    };
    let emission = (0..count).map(|_| some()).collect();
    (random::scene(seed, count, 5), emission)
}

fn bits(leaves: &[[f32; 3]]) -> Vec<[u32; 3]> {
    leaves.iter().map(|leaf| leaf.map(f32::to_bits)).collect()
}

#[test]
fn every_leaf_emits_the_mean_of_what_reaches_it() {
    for filter in [Filter::Nearest, Filter::Split] {
        let (voxels, emission) = scene(3, 1500);
        let found = gathered(&voxels, &emission, filter);
        let units: Vec<_> = emission.iter().map(|packed| unpacked(*packed)).collect();
        let placed = |place: &[u32; 2]| (place[0] != u32::MAX).then_some((place[0] as usize, place[1] as usize));
        let places: Vec<_> = found.built.places.iter().map(placed).collect();
        let starts: Vec<_> = found.built.block_starts.iter().map(|start| start[0] as usize).collect();
        let blocks = found.emits.len();
        let (sorted, emits) = place_emission_ref::place_emission(&units, &places, &starts[..blocks]);
        assert_eq!(found.sorted, sorted);
        assert_eq!(found.emits.iter().map(|word| *word == 1).collect::<Vec<_>>(), emits);
        let pairs = voxels.iter().zip(units).map(|(voxel, unit)| (voxel.q, voxel.coverage, unit));
        let expected = gather_emission_ref::gather_emission(pairs, 5, filter);
        assert_eq!(expected.len(), found.leaves.len());
        for (cell, slot) in rules::leaf_slots(&found.built) {
            for (channel, sum) in expected[&cell].into_iter().enumerate() {
                let mean = sum / f64::from(EMISSION_MAX);
                let off = (f64::from(found.leaves[slot][channel]) - mean).abs();
                assert!(off <= 4.0 * f64::from(f32::EPSILON) * mean, "{cell:?}: {:?}", found.leaves[slot]);
            }
        }
    }
}

#[test]
fn the_order_of_voxels_changes_no_bit() {
    let (voxels, emission) = scene(5, 900);
    let first = gathered(&voxels, &emission, Filter::Split);
    for step in [7, 11, 499] {
        let order: Vec<usize> = (0..voxels.len()).map(|i| i * step % voxels.len()).collect();
        let shuffled: Vec<_> = order.iter().map(|&i| voxels[i]).collect();
        let emission: Vec<_> = order.iter().map(|&i| emission[i]).collect();
        assert_eq!(bits(&gathered(&shuffled, &emission, Filter::Split).leaves), bits(&first.leaves));
    }
}

#[test]
fn many_voxels_in_a_leaf_keep_their_mean() {
    // More than one thread's short sums could hold; half of them dark.
    let voxels = vec![full([3, 3, 3], DVec3::Y, [255; 3]); 100_000];
    let emission: Vec<_> =
        (0..voxels.len()).map(|i| pack_emission(if i % 2 == 0 { [1.0, 0.25, 0.0] } else { [0.0; 3] }, 1.0)).collect();
    let found = gathered(&voxels, &emission, Filter::Nearest);
    let expected = [0.5, 0.125, 0.0];
    for (channel, mean) in expected.into_iter().enumerate() {
        assert!((f64::from(found.leaves[0][channel]) - mean).abs() < 1e-6, "{:?}", found.leaves);
    }
}
