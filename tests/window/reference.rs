//! The path tracer beside the picture: started, stopped, laid over the view, measured and saved.

use egui::{Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable as _;
use octolume::export::read_settings;
use octolume::settings::{NodeNames, SurfaceView, View};

use crate::rig::{Window, assert_changed, difference, small_grid, wgpu_setup};

/// The courtyard under a sky, its direct light shown, and the panel unfolded.
fn window() -> Window {
    let mut settings = small_grid();
    settings.method.look.view = View::Surfaces;
    settings.method.look.surface = SurfaceView::Direct;
    settings.method.lighting.sky_nits = [100.0; 3];
    let mut window = Window::with(wgpu_setup(), "courtyard", settings, NodeNames::default());
    ["Scene", "Discretization", "Filter", "Timings", "Octree", "Frame plan", "Reference"]
        .into_iter()
        .for_each(|section| window.click(section));
    // A small view: paths take their time.
    window.0.set_size(vec2(820.0, 440.0));
    window.settle();
    window.click("Measurements");
    window
}

fn traced() -> Window {
    let mut window = window();
    window.set("Samples", 2.0);
    window.click("Start");
    window
}

#[test]
fn paths_lie_over_the_picture_and_go_away() {
    let mut window = traced();
    assert!(window.0.query_by_label_contains("2 samples").is_some());
    let cones = window.view();
    window.click("Paths");
    let paths = window.view();
    assert_changed(&cones, &paths, "showing paths");
    window.click("Difference");
    assert_changed(&paths, &window.view(), "showing the difference");
    window.click("Cones");
    assert_eq!(difference(&cones, &window.view()), 0);
}

#[test]
fn direct_light_of_paths_looks_like_that_of_the_surface_image() {
    let mut window = traced();
    let cones = window.view();
    window.click("Paths");
    let paths = window.view();
    let far = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 16);
    let pixels = cones.pixels().zip(paths.pixels()).filter(|pair| far(*pair)).count();
    let all = cones.pixels().len();
    assert!(pixels * 10 < all, "{pixels} of {all} pixels are far off");
}

#[test]
fn a_wipe_is_dragged_over_the_view() {
    let mut window = traced();
    let cones = window.view();
    window.click("Wipe");
    window.set("Divider", 1.0);
    let all_cones = window.view();
    let middle = window.view_rect().center();
    window.set("Divider", 0.5);
    let half = window.view();
    assert_changed(&all_cones, &half, "the divider");
    let press = |pressed, pos| egui::Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let camera = window.app().settings().shot.camera;
    let aside = middle - vec2(100.0, 0.0);
    window.0.hover_at(middle);
    window.0.event(press(true, middle));
    window.0.hover_at(aside);
    window.0.event(press(false, aside));
    window.settle();
    assert_eq!(window.app().settings().shot.camera, camera, "the camera stays");
    assert_changed(&half, &window.view(), "dragging the divider");
    window.click("Cones");
    assert_eq!(difference(&cones, &window.view()), 0);
}

#[test]
fn a_reference_of_another_picture_is_told_from_one_of_this() {
    let note = "It is of another picture: camera, scene or light have changed.";
    let mut window = traced();
    window.click("Paths");
    assert_eq!(window.count(note), 0);
    window.press(Modifiers::NONE, egui::Key::F);
    assert_eq!(window.count(note), 1);
    window.press(Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(window.count(note), 0, "back at the camera it was traced from");
    window.press(Modifiers::NONE, egui::Key::F);
    window.click("Start");
    assert_eq!(window.count(note), 0);
}

/// A run that does not end by itself, after its first sample.
fn running() -> Window {
    let mut window = window();
    window.set("Samples", 60_000.0);
    window.0.get_by_label("Start").click();
    let until = std::time::Instant::now() + std::time::Duration::from_secs(60);
    while window.0.query_by_label_contains(" sample").is_none() {
        assert!(std::time::Instant::now() < until, "no sample in a minute");
        window.0.step();
    }
    assert!(!window.app().is_settled(), "it goes on");
    window
}

#[test]
fn a_run_is_stopped_and_goes_on() {
    let mut window = running();
    window.click("Stop");
    assert!(window.0.query_by_label_contains("of 60000: what is traced is kept").is_some());
    assert!(window.0.query_by_label("Start").is_some() && window.0.query_by_label_contains(" sample").is_some());
    window.set("Samples", 1.0);
    window.click("Start");
    assert!(window.0.query_by_label_contains(" sample").is_some(), "what was traced is still there");
}

#[test]
fn a_run_stops_when_its_picture_is_gone() {
    let mut window = running();
    window.press(Modifiers::NONE, egui::Key::F);
    let note = "of 60000, for the picture has changed";
    assert!(window.0.query_by_label("Start").is_some() && window.0.query_by_label_contains(note).is_some());
    window.press(Modifiers::COMMAND, egui::Key::Z);
    window.set("Samples", 1.0);
    window.click("Start");
    assert!(window.0.query_by_label_contains(note).is_none(), "as many as are asked for are there");
}

#[test]
fn another_picture_is_traced_instead_where_that_is_wanted() {
    let mut window = window();
    window.set("Samples", 1.0);
    window.click("Restart when the view changes");
    window.click("Start");
    window.click("Paths");
    let before = window.view();
    window.press(Modifiers::NONE, egui::Key::F);
    assert_eq!(window.count("It is of another picture: camera, scene or light have changed."), 0);
    assert!(window.0.query_by_label_contains("1 sample").is_some());
    assert_changed(&before, &window.view(), "paths of another camera");
}

#[test]
fn errors_of_the_parts_are_listed() {
    let window = traced();
    for part in ["Final", "Direct", "Diffuse", "Specular", "Occlusion"] {
        assert_eq!(window.count(part), 1, "{part}");
    }
    assert!(window.0.query_by_label_contains("all of the picture").is_some());
}

#[test]
fn what_lies_over_the_picture_is_saved_as_colours_and_as_light() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = traced();
    window.type_into("Save to", &folder.path().display().to_string());
    for way in ["Cones", "Paths"] {
        window.click(way);
        window.click("Screenshot");
        window.click("Save light");
    }
    let picture = |number: u32| {
        let file = folder.path().join(format!("octolume-courtyard-{number}.png"));
        let settings = read_settings(&file).expect("settings");
        assert_eq!(settings.method.look.surface, SurfaceView::Direct);
        image::open(file).expect("a picture").to_rgba8()
    };
    assert_changed(&picture(1), &picture(2), "saving paths");
    let light = |number: u32| {
        let file = folder.path().join(format!("octolume-courtyard-{number}.exr"));
        image::open(file).expect("light").to_rgba32f()
    };
    let (cones, paths) = (light(1), light(2));
    assert!(cones != paths && paths.pixels().all(|pixel| pixel.0.iter().all(|channel| channel.is_finite())));
    assert!(cones.pixels().any(|pixel| pixel.0[0] > 1.0), "nits, not shares");
}
