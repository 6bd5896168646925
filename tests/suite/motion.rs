//! What moves, what stretches, and the boxes of both.

use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;
use glam::{DMat3, DMat4, DQuat, DVec3};
use octolume::scene::{
    Channel, Interpolation, LocalTransform, Motion, Node, Object, Property, Scene, Trs, polar::right_polar,
};
use proptest::prelude::*;

use crate::scenes::*;

/// A rounding or two of an f64 near 1.
const ROUNDING: f64 = 1e-14;

#[test]
fn bounds_follow_the_pose() {
    let scene = sliding_scene();
    let start = scene.bounds_at(&scene.pose(Some(0), 0.0)).expect("a box");
    assert_eq!((start.min, start.max), (DVec3::splat(-1.0), DVec3::ONE));
    let over_time = scene.bounds_over_time().expect("a box");
    for frame in 0..=170 {
        let now = scene.bounds_at(&scene.pose(Some(0), f64::from(frame) / 100.0)).expect("a box");
        // Between samples a turning box may stick out, by less than it turns there.
        assert!(now.min.cmpge(over_time.min - 0.5).all() && now.max.cmple(over_time.max + 0.5).all());
    }
    let skinned = skinned_scene([0; 4], [1.0, 0.0, 0.0, 0.0], &[at(50.0, 0.0, 0.0)], &[DMat4::IDENTITY]);
    let bounds = skinned.bounds_over_time().expect("a box");
    assert_eq!((bounds.min, bounds.max), (DVec3::new(49.0, -1.0, -1.0), DVec3::new(51.0, 1.0, 1.0)));
}

#[test]
fn nothing_has_no_bounds() {
    assert_eq!(Scene::default().bounds_over_time(), None);
    let mut scene = cube_scene(Trs::default());
    scene.meshes[0].primitives.clear();
    assert_eq!(scene.bounds_at(&scene.pose(None, 0.0)), None);
    let infinite = cube_scene(at(f64::INFINITY, 0.0, 0.0));
    assert_eq!(infinite.bounds_over_time(), None, "what is nowhere does not count");
}

proptest! {
    /// A blend of joints never leaves the boxes its joints span.
    #[test]
    fn skinned_bounds_hold_every_vertex(angles in [-3.0..3.0f64, -3.0..3.0], shift in -5.0..5.0f64, share in 0.0..1.0f32) {
        let poses = [
            Trs { rotation: DQuat::from_rotation_z(angles[0]), ..at(shift, 0.0, 1.0) },
            Trs { rotation: DQuat::from_rotation_x(angles[1]), ..scaled(2.0, 1.0, 0.5) },
        ];
        let scene = skinned_scene([0, 1, 0, 0], [share, 1.0 - share, 0.0, 0.0], &poses, &[DMat4::IDENTITY; 2]);
        let mut moving = scene.clone();
        moving.clips.push(clip(vec![Channel { node: 1, ..channel(Property::Translation, Interpolation::Step, &[0.0], &[shift, 0.0, 9.0]) }]));
        let bounds = moving.bounds_over_time().expect("a box");
        for position in positions(&moving, &moving.pose(Some(0), 0.0)) {
            prop_assert!(position.cmpge(bounds.min - 1e-12).all() && position.cmple(bounds.max + 1e-12).all());
        }
    }

    /// W = R·U with R orthogonal and U symmetric positive definite, for mirrored matrices too.
    #[test]
    fn polar_parts_multiply_back(entries in proptest::array::uniform9(-1.0..1.0f64), magnitude in -20..20i32) {
        let w = DMat3::from_cols_array(&entries) * 2f64.powi(magnitude);
        let size = w.to_cols_array().iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        prop_assume!(w.determinant().abs() > 1e-4 * size.powi(3));
        let polar = right_polar(w).expect("regular");
        // The inverse amplifies roundings by the condition number, at most 3³/1e-4 here.
        prop_assert!((polar.rotation * polar.stretch).abs_diff_eq(w, 1e-9 * size));
        prop_assert!((polar.rotation.transpose() * polar.rotation).abs_diff_eq(DMat3::IDENTITY, 1e-9));
        prop_assert!(polar.stretch.abs_diff_eq(polar.stretch.transpose(), 0.0));
        prop_assert_eq!(polar.rotation.determinant() < 0.0, w.determinant() < 0.0);
        let [a, b, c] = [polar.stretch.x_axis, polar.stretch.y_axis, polar.stretch.z_axis];
        prop_assert!(a.x > 0.0 && a.x * b.y - a.y * b.x > 0.0 && polar.stretch.determinant() > 0.0, "Sylvester, {c}");
    }
}

fn only_object(scene: &Scene) -> Object {
    scene.objects().remove(0)
}

#[test]
fn a_constant_rest_value_is_not_motion() {
    let with = |interpolation, values: &[f64], rest: Trs| {
        let mut scene = cube_scene(rest);
        scene.clips.push(clip(vec![channel(Property::Translation, interpolation, &[0.0, 1.0], values)]));
        only_object(&scene).motion
    };
    let rest = at(1.0, 2.0, 3.0);
    assert_eq!(with(Interpolation::Linear, &[1.0, 2.0, 3.0, 1.0, 2.0, 3.0], rest), Motion::Static);
    assert_eq!(with(Interpolation::Linear, &[1.0, 2.0, 3.0, 1.0, 2.0, 3.1], rest), Motion::Rigid);
    assert_eq!(with(Interpolation::Step, &[0.0; 6], rest), Motion::Rigid, "constant, but not where it rests");
    let still = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 0.0, 0.0, 0.0].repeat(2);
    assert_eq!(with(Interpolation::CubicSpline, &still, rest), Motion::Static);
    let swings = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 0.0].repeat(2);
    assert_eq!(with(Interpolation::CubicSpline, &swings, rest), Motion::Rigid, "tangents move it");
}

#[test]
fn what_an_ancestor_does_is_motion() {
    let mut scene = sliding_scene();
    scene.nodes.push(node(Some(0), Trs::default()));
    scene.nodes.push(Node { mesh: Some(0), ..node(Some(1), Trs::default()) });
    scene.nodes.push(Node { mesh: Some(0), ..node(None, Trs::default()) });
    let motions: Vec<(usize, Motion)> = scene.objects().iter().map(|object| (object.node, object.motion)).collect();
    assert_eq!(motions, [(0, Motion::Rigid), (2, Motion::Rigid), (3, Motion::Static)]);
}

#[test]
fn rotations_stretch_nothing_at_all() {
    let turned = Trs { rotation: DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.3), ..at(5.0, 6.0, 7.0) };
    assert_eq!(only_object(&cube_scene(turned)).stretch, DMat3::IDENTITY, "exactly");
    assert_eq!(only_object(&cube_scene(Trs { scale: DVec3::splat(100.0), ..turned })).stretch.diagonal().x, 100.0);
    assert_eq!(only_object(&sliding_scene()).stretch, DMat3::IDENTITY);
}

/// A quarter turn below a scale of (2, 1, 1): U scales the child's y, not its x.
#[test]
fn a_turned_child_of_a_stretched_parent_bakes_shear() {
    let mut scene = cube_scene(Trs { rotation: DQuat::from_rotation_z(FRAC_PI_2), ..Trs::default() });
    let child = scene.nodes.remove(0);
    scene.nodes.push(node(None, scaled(2.0, 1.0, 1.0)));
    scene.nodes.push(Node { parent: Some(0), ..child });
    let stretch = only_object(&scene).stretch;
    assert_near!(stretch, DMat3::from_diagonal(DVec3::new(1.0, 2.0, 1.0)), ROUNDING);
    // An eighth of a turn: U² = WᵀW = [[2.5, −1.5], [−1.5, 2.5]] has eigenvalues 4 and 1 on the diagonals.
    scene.nodes[1].local = LocalTransform::Trs(Trs { rotation: DQuat::from_rotation_z(PI / 4.0), ..Trs::default() });
    let stretch = only_object(&scene).stretch;
    let expected = DMat3::from_cols(DVec3::new(1.5, -0.5, 0.0), DVec3::new(-0.5, 1.5, 0.0), DVec3::Z);
    assert_near!(stretch, expected, 1e-13);
}

#[test]
fn mirrored_objects_keep_a_positive_stretch() {
    assert_eq!(only_object(&cube_scene(scaled(-1.0, 1.0, 1.0))).stretch, DMat3::IDENTITY);
    let polar = right_polar(DMat3::from_diagonal(DVec3::new(-2.0, 3.0, 4.0))).expect("regular");
    assert_eq!(polar.rotation, DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
    assert_eq!(polar.stretch, DMat3::from_diagonal(DVec3::new(2.0, 3.0, 4.0)));
}

#[test]
fn singular_objects_are_hidden_and_named() {
    for hidden in [scaled(0.0, 0.0, 0.0), scaled(1.0, 0.0, 0.0), scaled(f64::NAN, 1.0, 1.0)] {
        let scene = cube_scene(hidden);
        assert_eq!(scene.motion_report(1.0, scene.first_clip()).hidden, [0]);
        assert_eq!(only_object(&scene).stretch, DMat3::IDENTITY);
        assert_eq!(
            scene.motion_report(1.0, scene.first_clip()).warnings(),
            ["object \"node\" is hidden: its matrix leaves no area, or is not finite, at all times"]
        );
    }
    let flat = cube_scene(scaled(2.0, 0.0, 1.0));
    assert!(flat.motion_report(1.0, None).hidden.is_empty());
    assert_eq!(only_object(&flat).stretch, DMat3::from_diagonal(DVec3::new(2.0, 0.0, 1.0)));
    // Popping up from nothing: what counts is when it is there.
    let mut scene = cube_scene(scaled(0.0, 0.0, 0.0));
    scene.clips.push(clip(vec![channel(
        Property::Scale,
        Interpolation::Step,
        &[0.0, 1.0],
        &[0.0, 0.0, 0.0, 3.0, 3.0, 3.0],
    )]));
    assert!(scene.motion_report(1.0, scene.first_clip()).hidden.is_empty());
    assert_eq!(only_object(&scene).stretch, DMat3::from_diagonal(DVec3::splat(3.0)));
}

fn breathing_scene(scales: &[f64]) -> Scene {
    let mut scene = cube_scene(scaled(scales[0], 1.0, 1.0));
    let times: Vec<f64> = (0..scales.len()).map(|key| key as f64).collect();
    let values: Vec<f64> = scales.iter().flat_map(|&scale| [scale, 1.0, 1.0]).collect();
    scene.clips.push(clip(vec![channel(Property::Scale, Interpolation::Linear, &times, &values)]));
    scene
}

#[test]
fn scale_keys_that_vary_in_the_last_bit_are_not_motion() {
    let ulp = f64::from(f32::EPSILON);
    let scene = breathing_scene(&[1.0, 1.0 + ulp, 1.0 - ulp, 1.0]);
    assert_eq!(only_object(&scene).motion, Motion::Static);
    assert!(scene.stretching_objects(1e-3).is_empty());
}

/// Scales 1, 1.5 (half-way) and 2: mean 1.5, so a cube of half size 1 is off by 0.5 at its ends.
#[test]
fn half_a_cell_of_stretch_is_named() {
    let scene = breathing_scene(&[1.0, 2.0]);
    assert_eq!(only_object(&scene).stretch, DMat3::from_diagonal(DVec3::new(1.5, 1.0, 1.0)));
    assert_eq!(scene.stretching_objects(0.25), [(0, 2.0)]);
    assert_eq!(scene.stretching_objects(1.0), [(0, 0.5)], "half a cell counts");
    assert!(scene.stretching_objects(1.001).is_empty());
    let baked = |span: f64| scene.motion_report(span, scene.first_clip()).objects[0].stretch;
    assert_eq!(baked(1.001), DMat3::from_diagonal(DVec3::new(1.5, 1.0, 1.0)), "the mean is near enough");
    assert_eq!(baked(0.25), DMat3::from_diagonal(DVec3::new(2.0, 1.0, 1.0)), "the largest leaves no holes");
    assert_eq!(scene.motion_report(0.25, None).objects[0].stretch, DMat3::IDENTITY, "another clip does not count");
    assert_eq!(scene.motion_report(0.25, scene.first_clip()).stretching, [(0, 2.0)]);
}

/// Joints of scale 1 and 3 with three quarters and one quarter of the weight: 1.5 for all parts.
#[test]
fn a_skin_has_one_mean_stretch() {
    let poses = [Trs::default(), scaled(3.0, 3.0, 3.0)];
    let mut scene = skinned_scene([0, 1, 0, 0], [0.75, 0.25, 0.0, 0.0], &poses, &[DMat4::IDENTITY; 2]);
    scene.nodes.push(Node { mesh: Some(0), skin: Some(0), ..node(None, scaled(9.0, 9.0, 9.0)) });
    let objects = scene.objects();
    assert_eq!(objects.len(), 2);
    for object in &objects {
        assert_eq!(object.motion, Motion::Skinned { skin: 0 });
        assert_eq!(object.stretch, DMat3::from_diagonal(DVec3::splat(1.5)));
    }
    // About the cube's centre, a corner is off by √3 · (0.75 · 0.5 + 0.25 · 1.5).
    let [(0, cells), (1, _)] = scene.stretching_objects(1.0)[..] else { panic!("both stretch") };
    assert_relative_eq!(cells, 0.75 * 3f64.sqrt(), epsilon = ROUNDING);
}

/// joint · inverse bind holds 100 · 0.01 in some exporters' files, 0.01 in others'.
#[test]
fn scale_inside_a_skin_is_baked() {
    let joint = scaled(0.01, 0.01, 0.01);
    let whole = skinned_scene([0; 4], [1.0, 0.0, 0.0, 0.0], &[joint], &[DMat4::from_scale(DVec3::splat(100.0))]);
    assert_eq!(only_object(&whole).stretch, DMat3::IDENTITY, "exactly");
    let small = skinned_scene([0; 4], [1.0, 0.0, 0.0, 0.0], &[joint], &[DMat4::IDENTITY]);
    assert_eq!(only_object(&small).stretch, DMat3::from_diagonal(DVec3::splat(0.01)));
    assert!(small.stretching_objects(1e-4).is_empty());
}
