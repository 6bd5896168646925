//! Joints, weights and normals against values worked out by hand.

use approx::assert_relative_eq;
use glam::{DMat3, DMat4, DQuat, DVec3, Vec3};
use octolume::scene::{Aabb, LocalTransform, Trs, geometry::normal_matrix};

use crate::{document::Document, scenes::*};

/// A rounding or two of an f64 near 1.
const ROUNDING: f64 = 1e-14;

/// Weights 0.49 and 0.49 in a rig 3 km away: 2 % short would be 60 m.
#[test]
fn weights_are_renormalised() {
    let document = Document::with_skin(2, &[([0, 1, 0, 0], [0.49, 0.49, 0.0, 0.0])]);
    let mut scene = document.open().expect("opens");
    assert_eq!(scene.meshes[0].primitives[0].weights[0], [0.5, 0.5, 0.0, 0.0]);
    for joint in scene.skins[0].joints.clone() {
        scene.nodes[joint].local = LocalTransform::Trs(at(3000.0, 0.0, 0.0));
    }
    assert_eq!(positions(&scene, &scene.pose(None, 0.0))[0], DVec3::new(3001.0, 0.0, 0.0));
    // Thirds are not f32 numbers; their sum is not 1, and a mean of equal matrices is still that matrix.
    let third = 1.0 / 3.0;
    let far = skinned_scene([0, 0, 0, 0], [third, third, third, 0.0], &[at(3e9, 0.0, 0.0)], &[DMat4::IDENTITY]);
    assert_relative_eq!(positions(&far, &far.pose(None, 0.0))[7].x, 3e9 + 1.0, max_relative = 2.0 * f64::EPSILON);
}

#[test]
fn all_zero_weights_follow_the_first_joint() {
    let scene = Document::with_skin(3, &[([2, 1, 0, 0], [0.0; 4])]).open().expect("opens");
    let primitive = &scene.meshes[0].primitives[0];
    assert_eq!((primitive.joints[0], primitive.weights[0]), ([2, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]));
    assert_eq!(
        scene.warnings,
        ["mesh 0 \"tri\", primitive 0: 3 vertices without joint weight, bound to the first joint named"]
    );
}

#[test]
fn a_second_set_is_merged_into_the_four_strongest() {
    let sets = [([0, 1, 2, 3], [0.05, 0.3, 0.1, 0.15]), ([4, 5, 6, 7], [0.2, 0.0, 0.05, 0.15])];
    let scene = Document::with_skin(8, &sets).open().expect("opens");
    let primitive = &scene.meshes[0].primitives[0];
    assert_eq!(primitive.joints[0], [1, 4, 3, 7], "strongest first, equals in the file's order");
    let expected = [0.3, 0.2, 0.15, 0.15].map(|weight: f64| weight / 0.8);
    for (weight, expected) in primitive.weights[0].into_iter().zip(expected) {
        assert_relative_eq!(f64::from(weight), expected, epsilon = f64::from(f32::EPSILON));
    }
    assert_eq!(
        scene.warnings,
        [
            "mesh 0 \"tri\", primitive 0: 3 vertices with more than 4 joints, of which the strongest are kept; up to 20.00 % of the weight of a vertex is dropped"
        ]
    );
}

#[test]
fn joints_out_of_range_are_refused() {
    let refusal = Document::with_skin(2, &[([0, 2, 0, 0], [0.5, 0.5, 0.0, 0.0])]).refusal();
    assert_eq!(
        refusal,
        "test.gltf: mesh 0 \"tri\", primitive 0, JOINTS_0: joint 2 is out of range: skin \"skin 0\" has 2"
    );
    let scene = Document::with_skin(1, &[([0, 9, 9, 9], [1.0, 0.0, 0.0, 0.0])]).open().expect("opens");
    assert_eq!(scene.meshes[0].primitives[0].joints[0], [0; 4], "what has no weight names no joint");
    let mut lone = Document::with_skin(1, &[([0; 4], [1.0, 0.0, 0.0, 0.0])]);
    lone.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().expect("an object").remove("WEIGHTS_0");
    assert!(lone.refusal().ends_with("WEIGHTS_0: is missing"));
}

#[test]
fn a_skin_without_weights_is_undone() {
    let scene = Document::with_skin(1, &[]).open().expect("opens");
    assert_eq!(scene.nodes[0].skin, None);
    assert!(scene.warnings[0].sentence.contains("its mesh has no joint weights; it moves as a whole"));
}

#[test]
fn garbage_without_weight_is_skipped() {
    let garbage = DMat4::from_diagonal(glam::DVec4::NAN);
    let scene = skinned_scene([0, 1, 1, 1], [1.0, 0.0, 0.0, 0.0], &[at(1.0, 0.0, 0.0); 2], &[DMat4::IDENTITY, garbage]);
    let pose = scene.pose(None, 0.0);
    assert!(positions(&scene, &pose).iter().all(|position| position.is_finite()));
    assert!(scene.posed_normals(&scene.objects()[0], 0, &pose).iter().all(|normal| *normal == DVec3::Z));
    assert_eq!(
        scene.bounds_over_time(),
        Some(Aabb { min: DVec3::new(0.0, -1.0, -1.0), max: DVec3::new(2.0, 1.0, 1.0) })
    );
    assert_eq!(scene.objects()[0].stretch, DMat3::IDENTITY);
}

#[test]
fn hundreds_of_joints_work() {
    for joint_count in [64, 257, 700] {
        let last = joint_count as u16 - 1;
        let scene = Document::with_skin(joint_count, &[([last, 0, 0, 0], [1.0, 0.0, 0.0, 0.0])]).open().expect("opens");
        let pose = scene.pose(None, 0.0);
        assert_eq!(scene.joint_matrices(0, &pose).len(), joint_count);
        assert_eq!(positions(&scene, &pose)[0], DVec3::new(f64::from(last) + 1.0, 0.0, 0.0));
    }
}

#[test]
fn the_skinned_node_stays_out_of_it() {
    let mut scene = skinned_scene([0; 4], [1.0, 0.0, 0.0, 0.0], &[at(5.0, 0.0, 0.0)], &[DMat4::IDENTITY]);
    let expected = positions(&scene, &scene.pose(None, 0.0));
    scene.nodes[0].local = LocalTransform::Trs(Trs { scale: DVec3::splat(7.0), ..at(100.0, 200.0, 300.0) });
    assert_eq!(positions(&scene, &scene.pose(None, 0.0)), expected);
    assert_eq!(expected[0], DVec3::new(4.0, -1.0, -1.0));
}

/// `world_from_joint · joint_from_mesh`: at bind time the two cancel, whatever scale hides in them.
#[test]
fn joint_matrices_are_joint_times_inverse_bind() {
    let joint = Trs { scale: DVec3::splat(100.0), rotation: DQuat::from_rotation_x(0.5), ..at(1.0, 2.0, 3.0) };
    let scene = skinned_scene([0; 4], [1.0, 0.0, 0.0, 0.0], &[joint], &[joint.matrix().inverse()]);
    let matrices = scene.joint_matrices(0, &scene.pose(None, 0.0));
    assert_near!(matrices[0], DMat4::IDENTITY, 1e-12);
    assert!(scene.joint_matrices(3, &scene.pose(None, 0.0)).is_empty());
}

/// Half of one joint and half of one that points the other way: the mean is zero.
#[test]
fn normals_of_opposed_joints_fall_back() {
    let turned = Trs { rotation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Trs::default() };
    let flipped = Trs { scale: DVec3::splat(-1.0), ..turned };
    for other in [turned, flipped] {
        let scene = skinned_scene([0, 1, 0, 0], [0.5, 0.5, 0.0, 0.0], &[Trs::default(), other], &[DMat4::IDENTITY; 2]);
        for normal in scene.posed_normals(&scene.objects()[0], 0, &scene.pose(None, 0.0)) {
            assert_relative_eq!(normal.length(), 1.0, epsilon = ROUNDING);
        }
    }
}

#[test]
fn mirrored_normals_point_outwards() {
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    assert_eq!(normal_matrix(&mirror) * DVec3::X, DVec3::NEG_X);
    assert_eq!(normal_matrix(&mirror) * DVec3::Y, DVec3::Y);
    let squashed = DMat3::from_diagonal(DVec3::new(2.0, 1.0, 1.0));
    let normal = (normal_matrix(&squashed) * DVec3::new(1.0, 1.0, 0.0)).normalize();
    assert_near!(normal, DVec3::new(1.0, 2.0, 0.0).normalize(), ROUNDING);
    let mut scene = cube_scene(scaled(-1.0, 3.0, 3.0));
    scene.meshes[0].primitives[0].normals[0] = Vec3::ZERO;
    let normals = scene.posed_normals(&scene.objects()[0], 0, &scene.pose(None, 0.0));
    assert_eq!((normals[0], normals[1]), (DVec3::ZERO, DVec3::Z));
}
