//! Skinned voxels: blended matrices against their reference, and the joints that are hard.

use glam::{DAffine3, DVec3};
use octolume::data::matrix::Matrix3x4;
use octolume::data::pages::SegmentOrder;
use octolume::data::voxel_cache::VoxelJoints;
use octolume::stages::transform::skinned_ref;

use crate::device::gpu;
use crate::moving::{
    DEPTH, as_fragment, check_moved, moved, position, random_cache, random_pose, random_rigid, skinned_part,
};
use crate::random::{self, ONE};
use crate::stage_rig::{self as rig, RigPart, World};

#[test]
fn random_skinned_motion_agrees_with_the_reference_with_any_number_of_joints() {
    let mut rng = random::rng(5);
    for joints in [1, 22, 64, 300] {
        let maps = random_pose(&mut rng, joints);
        // A rigid part in front, so that joint records and voxels are numbered apart.
        let still = RigPart {
            voxels: random_cache(&mut rng, 300, 48),
            matrices: vec![rig::matrix(&DAffine3::IDENTITY, 0.5)],
            ..RigPart::default()
        };
        let part = skinned_part(&mut rng, 3000, &maps);
        let found = World::moved(gpu(), &[still, part.clone()], DEPTH, SegmentOrder::default()).fragments(gpu());
        for (voxel, found) in found[300..].iter().enumerate() {
            let blended = skinned_ref::blended(&part.joints[voxel], &maps).expect("joints have a size");
            // Weight (4: a quotient is within 2.5 ulp), product, three sums of joints; then as rigid.
            check_moved(&part, &blended, voxel, found, 16.0).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

#[test]
fn one_joint_of_full_weight_moves_as_a_rigid_object_does() {
    let mut rng = random::rng(6);
    let (map, voxels) = (random_rigid(&mut rng), random_cache(&mut rng, 3000, 48));
    let rigid = moved(&map, [0; 3], &voxels);
    for slot in 0..4 {
        let (mut joints, mut weights) = ([9; 4], [0; 4]);
        (joints[slot], weights[slot]) = (1, 255);
        let part = RigPart {
            joints: vec![VoxelJoints { joints, weights }; voxels.len()],
            voxels: voxels.clone(),
            matrices: vec![Matrix3x4::default(), rig::matrix(&map, 0.5)],
            ..RigPart::default()
        };
        let skinned = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu());
        assert!(skinned == rigid, "weight {slot}");
    }
}

#[test]
fn a_joint_of_weight_zero_may_hold_garbage() {
    let mut rng = random::rng(7);
    let voxels = random_cache(&mut rng, 500, 48);
    let to = |x: f64| rig::matrix(&DAffine3::from_translation(DVec3::new(x, 3.0, 1.0)), 0.5);
    let garbage = Matrix3x4 { rows: [[f32::NAN; 4], [f32::INFINITY; 4], [1e38; 4]] };
    let part = RigPart {
        joints: vec![VoxelJoints { joints: [0, 1, 2, 2], weights: [85, 170, 0, 0] }; voxels.len()],
        voxels,
        matrices: vec![to(2.0), to(8.0), garbage],
        ..RigPart::default()
    };
    let found = World::moved(gpu(), std::slice::from_ref(&part), DEPTH, SegmentOrder::default()).fragments(gpu());
    for (voxel, found) in part.voxels.iter().zip(found) {
        // A third of 2 and two thirds of 8.
        let [x, y, z] = position(voxel);
        let found = found.expect("in the grid");
        assert!((found.q[0] - (x + 6) * ONE).abs() <= 1);
        assert_eq!(found.q[1..], [(y + 3) * ONE, (z + 1) * ONE]);
    }
}

#[test]
fn joints_that_cancel_leave_finite_voxels() {
    let turn = |degrees: f64| {
        let about = DAffine3::from_translation(DVec3::splat(24.0));
        about * DAffine3::from_rotation_z(degrees.to_radians()) * about.inverse()
    };
    let voxels = random_cache(&mut random::rng(8), 2000, 48);
    for (maps, weights) in [
        (vec![turn(0.0), turn(180.0), turn(0.0)], [127, 128, 0, 0]),
        (vec![turn(0.0), turn(120.0), turn(240.0)], [85, 85, 85, 0]),
        (vec![DAffine3::IDENTITY, DAffine3::from_scale(DVec3::splat(-1.0)), turn(0.0)], [127, 128, 0, 0]),
    ] {
        let part = RigPart {
            voxels: voxels.clone(),
            joints: vec![VoxelJoints { joints: [0, 1, 2, 0], weights }; voxels.len()],
            matrices: maps.iter().map(|map| rig::matrix(map, 0.5)).collect(),
            ..RigPart::default()
        };
        let found = World::moved(gpu(), &[part], DEPTH, SegmentOrder::default()).fragments(gpu());
        for (voxel, found) in voxels.iter().zip(found).filter_map(|(voxel, found)| Some((voxel, found?))) {
            let length = DVec3::from_array(found.normal.map(|n| f64::from(n) - 511.0)).length();
            let is_unit_or_zero = length == 0.0 || (length - 511.0).abs() <= 2.0;
            assert!(is_unit_or_zero && found.albedo == as_fragment(voxel, [0; 3]).albedo, "{found:?}");
        }
    }
}
