//! Objects together: at the grid's edge, far away, in moved and scaled scenes, in any page order.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use octolume::data::grid::Grid;
use octolume::data::pages::SegmentOrder;
use octolume::settings::Filter;
use octolume::stages::build::mark_ref::mark;
use octolume::stages::fill::gather_ref::Fragment;
use proptest::prelude::*;

use crate::device::{gpu, open};
use crate::moving::{DEPTH, moved, random_cache, random_pose, random_rigid, random_rotation, skinned_part};
use crate::octree_rules as rules;
use crate::random::{self, ONE};
use crate::stage_build::Shape;
use crate::stage_checks::{Expected, quotients};
use crate::stage_rig::{self as rig, RigPart, World};

#[test]
fn weight_inside_is_kept_and_weight_outside_is_counted_on_both_sides_of_every_face() {
    for axis in 0..3 {
        for (lower, is_near) in [(0, true), (63 * ONE, false)] {
            // Voxels that stick out by 1, 2 … 255 units, in rows of their own.
            let voxels: Vec<Fragment> = (1..256)
                .map(|out| {
                    let mut q = [2 * (out % 16) * ONE; 3];
                    q[(axis + 1) % 3] = 2 * (out / 16) * ONE;
                    q[axis] = if is_near { lower - out } else { lower + out };
                    Fragment { q, normal: [511; 3], albedo: [7; 3], coverage: 255 }
                })
                .collect();
            let words: Vec<_> = voxels.iter().map(rig::world_voxel).collect();
            let built = World::given(gpu(), &words).build(gpu(), &Shape::new(DEPTH, 3, Filter::Split));
            assert_eq!(built.clipped, (1..256).map(|out| out << 16).sum::<u64>());
            let mut kept: Vec<u32> = built.leaves.iter().map(|leaf| leaf[0]).collect();
            kept.sort_unstable();
            assert_eq!(kept, (1..256).map(|kept| kept << 16).collect::<Vec<u32>>());
        }
    }
}

#[test]
fn far_objects_vanish_and_leave_the_rest_unharmed() {
    let mut rng = random::rng(12);
    let near = RigPart {
        voxels: random_cache(&mut rng, 700, 48),
        matrices: vec![rig::matrix(&random_rigid(&mut rng), 0.5)],
        ..RigPart::default()
    };
    let alone = World::moved(gpu(), std::slice::from_ref(&near), DEPTH, SegmentOrder::default()).fragments(gpu());
    for distance in [1e3, 1e9, 1e30, -1e30, 3e38] {
        let far = DAffine3::from_translation(DVec3::new(1.0, distance, 1.0)) * DAffine3::from_rotation_x(0.3);
        let far = RigPart { matrices: vec![rig::matrix(&far, 0.5)], ..near.clone() };
        let found = World::moved(gpu(), &[far, near.clone()], DEPTH, SegmentOrder::default()).fragments(gpu());
        assert!(found[..700].iter().all(Option::is_none));
        assert!(found[700..] == alone, "{distance}");
    }
}

/// `grid_from_cache` of an object at a place in a scene, both scaled and moved.
fn folded(scale: f64, offset: DVec3, rotation: DQuat) -> DAffine3 {
    let span = 0.03 * scale;
    let grid = Grid {
        anchor: DVec3::new(-0.7, 0.2, -1.1) * scale + offset,
        offset_cells: glam::IVec3::new(-5, -9, -2),
        span,
        depth: DEPTH,
    };
    let place = DVec3::new(0.013, 0.877, -0.523) * scale + offset;
    let world_from_object = DMat4::from_rotation_translation(rotation, place);
    let object_from_cache = DMat4::from_scale(DVec3::splat(span));
    DAffine3::from_mat4(grid.grid_from_world() * world_from_object * object_from_cache)
}

fn scene_q(scale: f64, offset: DVec3, rotation: DQuat) -> Vec<Option<[i64; 3]>> {
    let voxels = random_cache(&mut random::rng(13), 4000, 40);
    moved(&folded(scale, offset, rotation), [-20; 3], &voxels).iter().map(|f| f.map(|f| f.q)).collect()
}

fn assert_within_a_unit(found: &[Option<[i64; 3]>], expected: &[Option<[i64; 3]>]) {
    assert!(expected.iter().flatten().count() > 3000);
    for (found, expected) in found.iter().zip(expected) {
        let (Some(found), Some(expected)) = (found, expected) else {
            // Only what just touches the grid may be in on one side.
            let touching = found.or(*expected).is_none_or(|q| q.iter().any(|c| *c <= 2 - ONE || *c >= 64 * ONE - 2));
            assert!(touching, "{found:?} {expected:?}");
            continue;
        };
        assert!((0..3).all(|axis| (found[axis] - expected[axis]).abs() <= 1), "{found:?} {expected:?}");
    }
}

#[test]
fn a_scene_moved_by_a_million_units_has_the_same_voxels() {
    for (turn, seed) in [(DQuat::IDENTITY, 0), (random_rotation(&mut random::rng(14)), 1)] {
        let at_home = scene_q(1.0, DVec3::ZERO, turn);
        for offset in [DVec3::splat(1e6), DVec3::new(-1e6, 12_345.6, 3e5)] {
            assert_within_a_unit(&scene_q(1.0, offset, turn), &at_home);
        }
        assert!(at_home.iter().any(Option::is_some), "{seed}");
    }
}

#[test]
fn a_scene_scaled_with_its_span_has_the_same_voxels() {
    let turn = random_rotation(&mut random::rng(15));
    let of_one = scene_q(1.0, DVec3::ZERO, turn);
    for exponent in [-20, 20] {
        assert!(scene_q(2.0_f64.powi(exponent), DVec3::ZERO, turn) == of_one, "2^{exponent}");
    }
    for scale in [1e-6, 1e6] {
        assert_within_a_unit(&scene_q(scale, DVec3::ZERO, turn), &of_one);
    }
}

/// Parts of different sizes, two of them skinned, that fill several segments each.
fn crowd(seed: u64) -> Vec<RigPart> {
    let mut rng = random::rng(seed);
    let counts = [700, 1, 256, 257, 900, 30];
    let part = |(index, count): (usize, usize)| {
        let maps = random_pose(&mut rng, if index % 3 == 2 { 5 } else { 1 });
        let mut part = skinned_part(&mut rng, count, &maps);
        if maps.len() == 1 {
            part.joints.clear();
        }
        RigPart { object: index as u32, ..part }
    };
    counts.into_iter().enumerate().map(part).collect()
}

#[test]
fn page_orders_and_workgroup_sizes_give_the_same_bits() {
    let parts = crowd(19);
    let shape = Shape::new(DEPTH, 3, Filter::Split);
    let first = World::moved(gpu(), &parts, DEPTH, SegmentOrder::LowestFirst);
    let (voxels, built) = (first.read(gpu()), first.build(gpu(), &shape));
    let highest = World::moved(gpu(), &parts, DEPTH, SegmentOrder::HighestFirst);
    assert!(highest.list.items.len() > first.list.items.len(), "the pages differ");
    assert!(highest.read(gpu()) == voxels);
    let other = highest.build(gpu(), &shape);
    assert!(other.leaves == built.leaves && other.nodes == built.nodes && other.leaf_objects == built.leaf_objects);
    let narrow = open().with_workgroup_size(32);
    let other = World::moved(&narrow, &parts, DEPTH, SegmentOrder::LowestFirst);
    assert!(other.read(&narrow) == voxels);
}

#[test]
fn a_moved_scene_agrees_with_the_references_to_the_last_leaf() {
    let parts = crowd(20);
    let order = |part: &&RigPart| !part.joints.is_empty();
    let (skinned, rigid): (Vec<_>, Vec<_>) = parts.iter().partition(order);
    let objects: Vec<u32> =
        rigid.into_iter().chain(skinned).flat_map(|part| vec![part.object; part.voxels.len()]).collect();
    let world = World::moved(gpu(), &parts, DEPTH, SegmentOrder::default());
    for filter in [Filter::Nearest, Filter::Split] {
        let shape = Shape::new(DEPTH, 3, filter);
        let built = world.build(gpu(), &shape);
        let expected = Expected::new(world.fragments(gpu()), &shape);
        let all = expected
            .check(&built)
            .and_then(|()| rules::validate(&built))
            .and_then(|()| rules::check_conservation(&built, &expected))
            .and_then(|()| expected.check_objects(&built, &objects));
        all.unwrap_or_else(|difference| panic!("{filter:?}: {difference}"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, max_shrink_iters: 8, ..ProptestConfig::default() })]

    /// Rigid voxels seven cells apart never share a leaf, so nothing is clamped: what the leaves hold and
    /// what was clipped is all there is.
    #[test]
    fn kept_and_clipped_are_all_there_is_after_any_motion(seed in any::<u64>(), skinned in any::<bool>()) {
        let mut rng = random::rng(seed);
        let maps = random_pose(&mut rng, 4);
        let mut part = skinned_part(&mut rng, 343, &maps);
        for (i, voxel) in (0..).zip(&mut part.voxels) {
            let cell = [i % 7, i / 7 % 7, i / 49].map(|c| 7 * c);
            voxel.position = octolume::data::packing::pack_position(cell);
        }
        if !skinned {
            part.joints.clear();
        }
        let world = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default());
        let built = world.build(gpu(), &Shape::new(DEPTH, 3, Filter::Split));
        let kept: u64 = built.leaves.iter().map(|leaf| u64::from(leaf[0])).sum();
        let marked = mark(quotients(&world.fragments(gpu())), DEPTH, Filter::Split);
        prop_assert_eq!(u128::from(built.clipped), marked.clipped);
        prop_assert_eq!(marked.kept + marked.clipped, 343 << 24);
        if !skinned {
            prop_assert_eq!(kept + built.clipped, 343 << 24);
        }
    }
}
