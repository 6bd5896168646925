//! What a scale takes away, and what the file hides: no voxel, no light, and voxels that fit the clip that is played.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use octolume::engine::Engine;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Channel, Clip, Interpolation, LocalTransform, Property, Scene, Trs};
use octolume::settings::{Discretization, Filter, Fit, FitTo, MotionSettings, Settings, Stretching};
use serde_json::json;

use crate::device;
use crate::document::Document;
use crate::scenes::cube_scene;

fn settings(grid: u32, clip: Option<&str>, time_secs: f64) -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization = Discretization { grid, ..Discretization::default() };
    settings.shot.motion = MotionSettings { clip: clip.map(str::to_owned), time_secs, ..MotionSettings::default() };
    settings
}

fn prepared(scene: &Scene, settings: &Settings) -> Prepared {
    prepare(Arc::new(scene.clone()), settings, None, &Progress::default()).expect("it fits")
}

/// Cells of the moved voxels, and those of the exact ones that they miss and add.
fn moved(scene: &Scene, settings: &Settings) -> (u64, u64, u64) {
    let prepared = Arc::new(prepared(scene, settings));
    let (motion, mut settings) = (settings.shot.motion.clone(), settings.clone());
    let hidden = prepared.hidden(&settings.shot.visibility, &prepared.pose(&motion).expect("poses")).expect("known");
    let exact = prepared.exact(&motion, &hidden, &Progress::default()).expect("an exact set");
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(prepared));
    engine.offer_exact(Arc::new(exact));
    settings.method.look.accuracy = true;
    engine.request(&settings, [16, 16]).expect("a request");
    engine.run_to_end().expect("a frame");
    let report = engine.accuracy().expect("measured");
    let of_filter = report.of(settings.method.discretization.filter);
    let of_filter = of_filter.expect("measured");
    (of_filter.leaves, of_filter.holes.expect("compared"), of_filter.spill.expect("compared"))
}

fn scaled(scale: DVec3) -> Trs {
    Trs { scale, ..Trs::default() }
}

/// Steps of scale for a node.
fn scales(node: usize, times: &[f64], scales: &[f64]) -> Channel {
    let values = scales.iter().flat_map(|&scale| [scale; 3]).collect();
    Channel { node, property: Property::Scale, interpolation: Interpolation::Step, times_secs: times.to_vec(), values }
}

/// A node goes from one place to another in a second.
fn slide(node: usize, places: [DVec3; 2]) -> Channel {
    Channel {
        node,
        property: Property::Translation,
        interpolation: Interpolation::Linear,
        times_secs: vec![0.0, 1.0],
        values: places.iter().flat_map(DVec3::to_array).collect(),
    }
}

/// A second cube beside the first, moved and scaled.
fn two_cubes(second: Trs) -> Scene {
    let mut scene = cube_scene(Trs::default());
    let mut other = scene.nodes[0].clone();
    (other.name, other.local) = ("second".to_owned(), LocalTransform::Trs(second));
    scene.nodes.push(other);
    scene
}

#[test]
fn objects_that_take_turns_by_scale_leave_no_holes() {
    let mut scene = two_cubes(Trs { translation: DVec3::new(0.013, 0.2, 0.1), ..Trs::default() });
    let turns = [scales(0, &[0.0, 1.0], &[1.0, 0.001]), scales(1, &[0.0, 1.0], &[0.001, 1.0])];
    scene.clips.push(Clip { name: "turns".to_owned(), duration_secs: 2.0, channels: turns.to_vec() });
    for time in [0.5, 1.5] {
        let mut settings = settings(64, None, time);
        settings.method.discretization.stretching = Stretching::Move;
        let (cells, holes, _) = moved(&scene, &settings);
        assert!(cells > 1000 && holes * 1000 < cells, "{time} s: {holes} holes of {cells}");
    }
}

#[test]
fn a_clip_that_is_not_played_changes_no_voxel() {
    let scene = two_cubes(Trs { translation: DVec3::X * 3.0, ..Trs::default() });
    let mut with_another = scene.clone();
    let slide = slide(0, [DVec3::ZERO, DVec3::Y / 2.0]);
    let idle = Clip { name: "idle".to_owned(), duration_secs: 1.0, channels: vec![slide] };
    let vanish =
        Clip { name: "vanish".to_owned(), duration_secs: 1.0, channels: vec![scales(1, &[0.0, 1.0], &[0.05, 40.0])] };
    with_another.clips = vec![idle, vanish];
    let idle = prepared(&with_another, &settings(64, Some("idle"), 0.0));
    let vanish = prepared(&with_another, &settings(64, Some("vanish"), 0.0));
    assert!(vanish.grid.span > 5.0 * idle.grid.span, "{} and {}", vanish.grid.span, idle.grid.span);
    assert_eq!(vanish.reach, idle.reach);
    let (cells, holes, _) = moved(&with_another, &settings(64, Some("idle"), 0.5));
    assert!(cells > 500 && holes * 1000 < cells, "{holes} holes of {cells}");
    let (cells, holes, _) = moved(&with_another, &settings(64, Some("vanish"), 0.9));
    assert!(cells > 10 && holes * 100 < cells, "{holes} holes of {cells}");
}

#[test]
fn a_scale_of_zero_hides_and_along_one_axis_flattens() {
    let mut scene = two_cubes(Trs { translation: DVec3::X * 3.0, ..Trs::default() });
    scene.clips.push(Clip {
        name: "hide".to_owned(),
        duration_secs: 2.0,
        channels: vec![scales(0, &[0.0, 1.0], &[1.0, 0.0])],
    });
    let cells = |time| moved(&scene, &settings(64, None, time));
    let (both, one) = (cells(0.5), cells(1.5));
    assert_eq!([both.1, one.1, one.2], [0; 3], "exact and moved hide the same");
    assert!(one.0 > 500 && both.0 > one.0 + 500, "{both:?} {one:?}");
    let flat = two_cubes(Trs { translation: DVec3::X * 3.0, scale: DVec3::new(1.0, 0.0, 1.0), ..Trs::default() });
    let (cells, holes, spill) = moved(&flat, &settings(64, None, 0.0));
    assert_eq!((holes, spill), (0, 0), "it never moves");
    assert!(cells > 500);
    // Flat and moving: its voxels keep their thickness.
    let mut moving = flat.clone();
    let slide = slide(1, [DVec3::X * 3.0, DVec3::new(3.0, 0.7, 0.3)]);
    moving.clips.push(Clip { name: "slide".to_owned(), duration_secs: 1.0, channels: vec![slide] });
    let (cells, holes, _) = moved(&moving, &settings(64, None, 0.5));
    assert!(holes * 100 < cells, "{holes} holes of {cells}");
}

#[test]
fn still_instances_are_exact() {
    let turned = |translation| Trs { translation, rotation: DQuat::from_rotation_y(0.6), ..Trs::default() };
    let mut scene = two_cubes(turned(DVec3::new(3.3, 0.11, 0.7)));
    scene.nodes[0].local = LocalTransform::Trs(turned(DVec3::new(0.013, 0.3, 0.2)));
    for filter in [Filter::Nearest, Filter::Split] {
        let mut settings = settings(64, None, 0.0);
        settings.method.discretization.filter = filter;
        let (cells, holes, spill) = moved(&scene, &settings);
        assert!(cells > 500 && (holes, spill) == (0, 0), "{filter:?}: {holes} holes, {spill} spill of {cells}");
    }
}

#[test]
fn what_is_hidden_or_far_away_sets_no_span_unless_asked() {
    let far = Trs { translation: DVec3::splat(1000.0), ..scaled(DVec3::splat(0.01)) };
    let scene = two_cubes(far);
    let span = |to: FitTo, only: &[usize]| {
        let mut settings = settings(64, None, 0.0);
        settings.shot.fit = Fit { to, ..Fit::default() };
        settings.shot.fit.counted.only = only.iter().copied().collect();
        let prepared = prepared(&scene, &settings);
        (prepared.grid.span, prepared.warnings.iter().filter(|warning| warning.nodes == [1]).count())
    };
    let (alone, _) = span(FitTo::Clip, &[0]);
    assert_eq!(span(FitTo::Clip, &[]), (alone, 1), "what lies apart is named");
    assert_eq!(span(FitTo::Pose, &[]), (alone, 1));
    assert!(span(FitTo::Scene, &[]).0 > 100.0 * alone);
    assert!(span(FitTo::Clip, &[0, 1]).0 > 100.0 * alone, "what is chosen counts");
    let (boxed, _) = span(FitTo::Box { min: DVec3::ZERO, max: DVec3::splat(62.0) }, &[]);
    assert_eq!(boxed, 1.0);
}

#[test]
fn the_file_hides_nodes_with_all_below_them_for_good_or_for_a_time() {
    let mut document = Document::with_triangle();
    document.json["nodes"][0]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
    document.json["extensionsUsed"] = json!(["KHR_node_visibility", "KHR_animation_pointer"]);
    document.add("nodes", json!({ "mesh": 0, "name": "below" }));
    document.json["nodes"][0]["children"] = json!([1]);
    let scene = document.open().expect("opens");
    assert!(scene.warnings.iter().all(|warning| !warning.sentence.contains("visibility")), "{:?}", scene.warnings);
    assert_eq!(scene.pose(None, 0.0).is_visible, [false, false]);
    let (times, values) =
        (document.floats("SCALAR", &[0.0, 1.0]), document.accessor(crate::document::U8, "SCALAR", 2, &[0, 1]));
    let pointer = json!({ "pointer": "/nodes/0/extensions/KHR_node_visibility/visible" });
    document.add("animations", json!({
        "samplers": [{ "input": times, "output": values, "interpolation": "STEP" }],
        "channels": [{ "sampler": 0, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": pointer } } }],
    }));
    let scene = document.open().expect("opens");
    let visible = |time| scene.pose(Some(0), time).is_visible;
    assert_eq!([visible(0.5), visible(1.5)], [[false, false], [true, true]]);
    let prepared = prepared(&scene, &settings(64, None, 1.5));
    let hidden = |time_secs| {
        let motion = MotionSettings { time_secs, ..MotionSettings::default() };
        let hidden = prepared.hidden(&Default::default(), &prepared.pose(&motion).expect("poses")).expect("known");
        [0, 1].map(|object| hidden.contains(object))
    };
    assert_eq!([hidden(0.5), hidden(1.5)], [[true; 2], [false; 2]]);
}

#[test]
fn a_lamp_of_scale_zero_lights_nothing() {
    let mut document = Document::with_triangle();
    document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    document.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    document.add("nodes", json!({ "scale": [0, 0, 0], "extensions": { "KHR_lights_punctual": { "light": 0 } } }));
    let scene = document.open().expect("opens");
    let settings = settings(64, None, 0.0);
    let prepared = prepared(&scene, &settings);
    let shown = prepared.shown_nodes(&settings.shot.visibility, &prepared.pose(&settings.shot.motion).expect("poses"));
    assert_eq!(shown.expect("known"), [true, false]);
}

#[test]
fn a_grid_beside_everything_says_so() {
    let scene = cube_scene(Trs::default());
    let mut settings = settings(64, None, 0.0);
    settings.shot.fit = Fit { to: FitTo::Box { min: DVec3::splat(50.0), max: DVec3::splat(51.0) }, ..Fit::default() };
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(prepared(&scene, &settings))));
    engine.request(&settings, [16, 16]).expect("a request");
    let told = engine.left_out();
    assert!(told.len() == 1 && told[0].starts_with("nothing that is shown is in the grid"), "{told:?}");
    settings.shot.visibility.hide(0);
    engine.request(&settings, [16, 16]).expect("a request");
    assert_eq!(engine.left_out(), [""; 0], "nothing is shown");
}

#[test]
fn a_first_picture_shows_what_is_there_when_the_clip_begins_large() {
    let mut scene = cube_scene(Trs::default());
    let channels = vec![slide(0, [DVec3::ZERO, 100.0 * DVec3::X])];
    scene.clips.push(Clip { name: "walk".to_owned(), duration_secs: 1.0, channels });
    let camera = |fit: FitTo, time_secs: f64| {
        let mut settings = settings(64, Some("walk"), time_secs);
        settings.shot.fit = Fit { to: fit, ..Fit::default() };
        let prepared = prepared(&scene, &settings);
        let pose = prepared.pose(&settings.shot.motion).expect("poses");
        prepared.camera(&settings, &pose, [64, 64])
    };
    let first = camera(FitTo::Clip, 0.0);
    let cube = scene.bounds_at(&scene.pose(None, 0.0)).expect("a cube");
    assert!(first.distance() < 5.0 * cube.size().max_element() && first.target == cube.center(), "{first:?}");
    for (fit, time_secs) in [(FitTo::Clip, 0.5), (FitTo::Scene, 0.0), (FitTo::Pose, 0.7)] {
        assert_eq!(camera(fit, time_secs), first, "it stands still, whatever the grid encloses");
    }
}
