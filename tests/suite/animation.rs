//! Sampling of clips against values worked out by hand.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use approx::assert_relative_eq;
use glam::{DMat3, DMat4, DQuat, DVec3};
use octolume::scene::{Channel, Interpolation, LocalTransform, Node, Pose, Property, Scene, Trs};
use serde_json::json;

use crate::{document::Document, scenes::*};

/// A rounding or two of an f64 near 1.
const ROUNDING: f64 = 1e-14;

#[test]
fn a_time_on_a_key_gives_the_stored_value() {
    let times = [0.1, 0.3, 0.7];
    let values = [0.1, 1.0 / 3.0, 1e-300, -7.7, 1e17, 2.0, 3.0, 4.0, 5.0];
    for interpolation in [Interpolation::Step, Interpolation::Linear] {
        let channel = channel(Property::Translation, interpolation, &times, &values);
        for (key, &time) in times.iter().enumerate() {
            assert_eq!(channel.sample_vector(time).to_array(), values[3 * key..3 * key + 3]);
        }
    }
    let tangents: Vec<f64> = values.chunks(3).flat_map(|value| [&[9.0; 3], value, &[-9.0; 3]].concat()).collect();
    let channel = channel(Property::Scale, Interpolation::CubicSpline, &times, &tangents);
    for (key, &time) in times.iter().enumerate() {
        assert_eq!(channel.sample_vector(time).to_array(), values[3 * key..3 * key + 3]);
    }
}

#[test]
fn before_and_after_the_keys_the_value_stays() {
    let channel = channel(Property::Translation, Interpolation::Linear, &[1.0, 2.0], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    for (time, expected) in [
        (f64::NEG_INFINITY, [1.0, 2.0, 3.0]),
        (-1.0, [1.0, 2.0, 3.0]),
        (1.0 - f64::EPSILON, [1.0, 2.0, 3.0]),
        (1.5, [2.5, 3.5, 4.5]),
        (2.0 + f64::EPSILON, [4.0, 5.0, 6.0]),
        (f64::INFINITY, [4.0, 5.0, 6.0]),
        (f64::NAN, [1.0, 2.0, 3.0]),
    ] {
        assert_eq!(channel.sample_vector(time).to_array(), expected, "{time}");
    }
}

#[test]
fn one_key_or_no_duration_is_constant() {
    for interpolation in [Interpolation::Step, Interpolation::Linear] {
        let still = channel(Property::Translation, interpolation, &[0.0], &[1.0, 2.0, 3.0]);
        let clip = clip(vec![still]);
        assert_eq!((clip.duration_secs, clip.sample_times(9)), (0.0, vec![0.0]));
        for time in [-1.0, 0.0, 1.0] {
            assert_eq!(clip.channels[0].sample_vector(time), DVec3::new(1.0, 2.0, 3.0));
        }
    }
    let spline = channel(
        Property::Translation,
        Interpolation::CubicSpline,
        &[5.0],
        &[9.0, 9.0, 9.0, 1.0, 2.0, 3.0, 9.0, 9.0, 9.0],
    );
    assert_eq!(spline.sample_vector(6.0), DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn step_holds_until_the_next_key() {
    let channel = channel(Property::Scale, Interpolation::Step, &[0.0, 1.0], &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(channel.sample_vector(1.0 - 1e-12), DVec3::ONE);
    assert_eq!(channel.sample_vector(1.0), DVec3::splat(2.0));
}

/// A document whose node 0 is animated with the given key times.
fn animated(times: &[f32]) -> Document {
    let mut document = Document::with_triangle();
    let values: Vec<f32> = times.iter().flat_map(|time| [*time, 0.0, 0.0]).collect();
    let (input, output) = (document.floats("SCALAR", times), document.floats("VEC3", &values));
    document.add(
        "animations",
        json!({
            "name": "walk", "samplers": [{ "input": input, "output": output }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
        }),
    );
    document
}

#[test]
fn keys_that_make_no_sense_are_repaired_and_named() {
    let sound = animated(&[0.0, 0.5, 2.0]).open().expect("opens");
    assert_eq!((sound.clips[0].duration_secs, sound.warnings.len()), (2.0, 0));
    let opened = |times: &[f32]| {
        let scene = animated(times).open().expect("opens");
        let channel = scene.clips[0].channels.first().map(|channel| channel.times_secs.clone());
        (channel.unwrap_or_default(), scene.warnings.last().map(|warning| warning.sentence.clone()).unwrap_or_default())
    };
    let start = "animation 0 \"walk\", translation of node 0 \"n\": ";
    let expected = format!("{start}1 key at the time of the one before; the value jumps there");
    assert_eq!(opened(&[0.0, 1.0, 1.0]), (vec![0.0, 1.0, 1.0], expected));
    let expected = format!("{start}1 key out of order; they are sorted by time");
    assert_eq!(opened(&[0.0, 1.0, 0.5]), (vec![0.0, 0.5, 1.0], expected));
    let expected = format!("{start}1 key without a finite time, value or rotation left out");
    assert_eq!(opened(&[0.0, f32::NAN, 0.5]), (vec![0.0, 0.5], expected));
    assert_eq!(opened(&[]), (vec![], format!("{start}it has no keys; it is left out")));
    let mut document = animated(&[0.0, 1.0]);
    let longer = document.floats("SCALAR", &[0.0, 1.0, 2.0]);
    document.json["animations"][0]["samplers"][0]["input"] = json!(longer);
    let scene = document.open().expect("opens");
    assert_eq!(scene.clips[0].channels.len(), 0);
    let last = scene.warnings.last().expect("a warning");
    assert_eq!(*last, format!("{start}it has 6 numbers for 3 keys, which need 9; it is left out"));
}

/// The axes as the rotation turns them: equal for q and −q.
fn turned(q: DQuat) -> [DVec3; 3] {
    DMat3::from_quat(q).to_cols_array_2d().map(DVec3::from_array)
}

#[test]
fn q_and_minus_q_are_one_pose() {
    let keys = [
        (DQuat::IDENTITY, DQuat::from_rotation_y(1.0)),
        (DQuat::from_rotation_x(3.0), DQuat::from_rotation_z(-2.9)),
        (DQuat::IDENTITY, DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0)), // exactly 180°
        (DQuat::IDENTITY, DQuat::from_rotation_y(1e-9)),
        (DQuat::IDENTITY, DQuat::IDENTITY),
    ];
    for (a, b) in keys {
        for time in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let turns = [(a, b), (-a, b), (a, -b), (-a, -b)]
                .map(|(a, b)| turned(rotation(Interpolation::Linear, &[a, b]).sample_rotation(time)));
            assert!(turns.iter().all(|turn| *turn == turns[0]), "{a} to {b} at {time}");
        }
    }
}

#[test]
fn rotations_take_the_shorter_way_at_even_speed() {
    let (a, b) = (DQuat::from_rotation_y(0.2), DQuat::from_rotation_y(2.2));
    let channel = rotation(Interpolation::Linear, &[a, -b]);
    for fraction in [0.25, 0.5, 0.75] {
        let expected = DQuat::from_rotation_y(0.2 + 2.0 * fraction);
        assert_relative_eq!(channel.sample_rotation(fraction).dot(expected).abs(), 1.0, epsilon = ROUNDING);
    }
}

/// Near dot = 1 the arc is a straight line, and nothing divides by its vanishing sine.
#[test]
fn tiny_turns_interpolate_linearly() {
    for angle in [0.0, 1e-300, 1e-16, 1e-9, 1e-7, 1e-5, 1e-3] {
        let channel = rotation(Interpolation::Linear, &[DQuat::IDENTITY, DQuat::from_rotation_x(angle)]);
        let half = channel.sample_rotation(0.5);
        assert_relative_eq!(half.length(), 1.0, epsilon = ROUNDING);
        assert_relative_eq!(half.x, (angle / 4.0).sin(), max_relative = 1e-9);
    }
}

#[test]
fn half_turns_are_deterministic() {
    for wobble in [0.0, 1e-17, -1e-17, 1e-12, -1e-12] {
        let b = DQuat::from_xyzw(0.0, 1.0, 0.0, wobble).normalize();
        let channel = rotation(Interpolation::Linear, &[DQuat::IDENTITY, b]);
        let (first, second) = (channel.sample_rotation(0.5), channel.sample_rotation(0.5));
        assert_eq!(first, second);
        assert_relative_eq!(first.length(), 1.0, epsilon = ROUNDING);
        assert_relative_eq!(first.y.abs(), FRAC_1_SQRT_2, epsilon = 1e-11);
    }
}

fn spline(property: Property, from: &[f64], out: &[f64], into: &[f64], to: &[f64]) -> Channel {
    let zeros = vec![0.0; from.len()];
    let values = [&zeros, from, out, into, to, &zeros].concat();
    channel(property, Interpolation::CubicSpline, &[0.0, 2.0], &values)
}

/// Keys 0 and 0 with slopes 8 and −8 a second over 2 s: 16·(s − s²) on s = t/2, 4 half-way.
#[test]
fn splines_overshoot_freely() {
    let channel = spline(Property::Translation, &[0.0; 3], &[8.0, 0.0, 1.0], &[-8.0, 0.0, 1.0], &[0.0; 3]);
    assert_eq!(channel.sample_vector(1.0), DVec3::new(4.0, 0.0, 0.0));
    let s: f64 = 0.125;
    assert_relative_eq!(channel.sample_vector(2.0 * s).x, 16.0 * (s - s * s), epsilon = ROUNDING);
}

#[test]
fn spline_rotations_are_normalised() {
    let (a, b) = (DQuat::IDENTITY.to_array(), DQuat::from_rotation_z(FRAC_PI_2).to_array());
    let channel = spline(Property::Rotation, &a, &[3.0, 0.0, 0.0, 9.0], &[0.0, -5.0, 0.0, 1.0], &b);
    for step in 0..=20 {
        assert_relative_eq!(channel.sample_rotation(f64::from(step) / 10.0).length(), 1.0, epsilon = ROUNDING);
    }
    // Without tangents the half-way point is the mean of the keys: an eighth of a turn.
    let plain = spline(Property::Rotation, &a, &[0.0; 4], &[0.0; 4], &b);
    assert_relative_eq!(plain.sample_rotation(1.0).dot(DQuat::from_rotation_z(PI / 4.0)), 1.0, epsilon = ROUNDING);
}

/// From q to −q without tangents the spline passes through zero, which has no direction.
#[test]
fn opposite_tangents_give_no_nan() {
    let (a, b) = (DQuat::IDENTITY.to_array(), (-DQuat::IDENTITY).to_array());
    let through_zero = spline(Property::Rotation, &a, &[0.0; 4], &[0.0; 4], &b);
    assert_eq!(through_zero.sample_rotation(1.0), DQuat::IDENTITY);
    // Tangents that cancel the keys: ½ + ½ + (2/8)·(−2 − 2) = 0.
    let cancelled = spline(Property::Rotation, &a, &[0.0, 0.0, 0.0, -2.0], &[0.0, 0.0, 0.0, 2.0], &a);
    assert_eq!(cancelled.sample_rotation(1.0), DQuat::IDENTITY);
    let nothing = spline(Property::Rotation, &[0.0; 4], &[0.0; 4], &[0.0; 4], &[0.0; 4]);
    assert_eq!(nothing.sample_rotation(1.0), DQuat::IDENTITY);
}

#[test]
fn scrub_equals_play() {
    let scene = sliding_scene();
    let frames: Vec<Pose> = (0..200).map(|frame| scene.pose(Some(0), f64::from(frame) / 60.0)).collect();
    for frame in (0..200).rev() {
        assert_eq!(scene.pose(Some(0), f64::from(frame) / 60.0), frames[frame as usize]);
    }
}

/// The time of a frame is its tick divided, never a sum: the pose is that of the exact time, to the
/// rounding of the division by the interval and of the product with it.
#[test]
fn a_million_frames_do_not_drift() {
    let end = 32_768.0;
    let slide = channel(Property::Translation, Interpolation::Linear, &[0.0, end], &[0.0, 0.0, 0.0, end, 0.0, 0.0]);
    for tick in 0..1_000_000 {
        let time_secs = f64::from(tick) / 60.0;
        let error = (slide.sample_vector(time_secs).x - time_secs).abs();
        assert!(error <= 2.0 * f64::EPSILON * time_secs, "tick {tick}: {error}");
    }
}

#[test]
fn a_pose_composes_parents_and_spares_matrices() {
    let mut scene = Scene::default();
    scene.nodes.push(node(None, Trs { rotation: DQuat::from_rotation_z(FRAC_PI_2), ..at(1.0, 0.0, 0.0) }));
    scene.nodes.push(node(Some(0), at(2.0, 0.0, 0.0)));
    let matrix = LocalTransform::Matrix(DMat4::from_translation(DVec3::Y));
    scene.nodes.push(Node { local: matrix, ..node(Some(1), Trs::default()) });
    let ignored = Channel { node: 2, ..channel(Property::Translation, Interpolation::Step, &[0.0], &[9.0, 9.0, 9.0]) };
    scene.clips.push(clip(vec![ignored]));
    let pose = scene.pose(Some(0), 0.0);
    assert_near!(pose.world_from_node[2].w_axis.truncate(), DVec3::new(0.0, 2.0, 0.0), ROUNDING);
    assert_eq!(scene.pose(Some(7), 1.0), scene.pose(None, 0.0), "a clip that is not there is the rest pose");
}
