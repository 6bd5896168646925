//! The real window without a display: driven by label on the software GPU, its pixels compared.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::unreachable,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

mod controls;
mod files;
mod lights;
mod looks;
mod measure;
mod node;
mod notes;
mod opening;
mod playing;
#[path = "../suite/real_scenes.rs"]
mod real_scenes;
mod reference;
mod remembered;
mod rig;
mod surfaces;
mod tree;

use std::time::Duration;

use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable as _;
use octolume::app::App;
use octolume::digest::Digest;
use octolume::export::read_settings;
use octolume::scene::{OrbitCamera, builtin};
use octolume::settings::{Filter, View};

use files::Dropped;
use real_scenes::real_scenes;
use rig::{Window, assert_changed, difference, new_device, wgpu_setup};

#[test]
fn the_camera_orbits_pans_zooms_and_frames_everything_again() {
    let mut window = Window::open("courtyard");
    let through_its_camera = window.view();
    window.press(Modifiers::NONE, Key::F);
    let framed = window.view();
    assert_changed(&through_its_camera, &framed, "framing everything");
    let center = window.view_rect().center();
    let drag = |window: &mut Window, button, by| {
        let press = |pressed, pos| egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
        window.0.hover_at(center);
        window.0.event(press(true, center));
        window.0.hover_at(center + by);
        window.0.event(press(false, center + by));
        window.settle();
    };
    for button in [egui::PointerButton::Secondary, egui::PointerButton::Middle] {
        drag(&mut window, button, vec2(60.0, 40.0));
        assert_changed(&framed, &window.view(), "dragging");
        window.press(Modifiers::NONE, Key::F);
        assert_eq!(difference(&framed, &window.view()), 0, "F frames everything again");
    }
    let camera = |window: &Window| window.app().settings().shot.camera.expect("it was moved");
    let side = |camera: &OrbitCamera| (camera.eye - camera.target).normalize();
    let at_first = camera(&window);
    drag(&mut window, egui::PointerButton::Primary, vec2(60.0, 0.0));
    let turned = camera(&window);
    assert_changed(&framed, &window.view(), "turning");
    assert!(side(&turned).distance(side(&at_first)) > 0.01);
    drag(&mut window, egui::PointerButton::Secondary, vec2(60.0, 40.0));
    window.press(Modifiers::NONE, Key::F);
    let again = camera(&window);
    assert!(side(&again).distance(side(&turned)) < 1e-9, "F keeps the side that is looked from");
    assert!(again.target.distance(at_first.target) < 1e-9 && (again.distance() - at_first.distance()).abs() < 1e-9);
}

#[test]
fn a_screenshot_carries_the_settings_and_has_the_size_of_the_view() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("courtyard");
    window.type_into("Save to", &folder.path().display().to_string());
    window.click("Nearest");
    window.set("Level", 5.0);
    window.click("Screenshot");
    let file = folder.path().join("octolume-courtyard-1.png");
    let settings = read_settings(&file).expect("settings in the picture");
    assert_eq!(settings.method.discretization.filter, Filter::Nearest);
    assert_eq!(settings.method.look.level, Some(5));
    assert!(settings.shot.camera.is_some(), "the camera is told, also where it frames everything");
    let rect = window.view_rect();
    assert_eq!(settings.shot.size_px, Some([rect.width().round() as u32, rect.height().round() as u32]));
    let scene = settings.shot.scene.expect("the scene is told");
    let bytes = builtin::bytes("courtyard").expect("a built-in scene");
    assert_eq!((scene.source.as_str(), scene.digest), ("courtyard", Some(Digest::of_file(bytes))));
    window.press(Modifiers::COMMAND, Key::S);
    assert!(folder.path().join("octolume-courtyard-2.png").exists());
}

#[test]
fn measuring_shows_holes_and_spill_of_both_filters() {
    let mut window = Window::open("courtyard");
    window.set("Turn y", 10.0);
    window.click("Measure both filters");
    let values: Vec<_> = window.0.get_all_by_label_contains(" %").filter_map(|node| node.value()).collect();
    // Shares of time have no decimals.
    let shares = values.iter().filter(|value| value.contains('.')).count();
    assert_eq!(shares, 2, "of nearest and of split: {values:?}");
}

#[test]
fn a_file_that_cannot_be_opened_leaves_the_scene_open() {
    let mut window = Window::open("courtyard");
    let before = window.view();
    window.type_into("Path", "no/such/file.glb");
    window.click("Open");
    assert!(window.log_holds("no/such/file.glb: cannot be read"));
    window.outlast_notes();
    assert_eq!(difference(&before, &window.view()), 0);
}

#[test]
fn a_still_scene_asks_for_no_repaint_and_runs_nothing() {
    let mut window = Window::open("courtyard");
    window.0.run_steps(8);
    assert!(!window.0.ctx.has_requested_repaint());
    let counters = window.app().gpu().counters();
    window.0.run_steps(8);
    assert_eq!(window.app().gpu().counters(), counters);
}

#[test]
fn a_lost_gpu_keeps_scene_and_settings_for_a_new_one() {
    let mut window = Window::on(new_device(), "courtyard");
    window.set("Level", 5.0);
    let before = window.view();
    window.app().gpu().device.destroy();
    // Nobody notices before something is to be drawn.
    window.0.get_by_label("Nearest").click();
    window.0.run_steps(4);
    let kept = window.app().rescued().expect("scene and settings are kept");
    drop(window);
    let mut again = Window::build(wgpu_setup(), move |context| App::again(context, kept).expect("a window"));
    assert_eq!(again.app().settings().method.look.level, Some(5));
    again.click("Split");
    again.outlast_notes();
    assert_eq!(difference(&before, &again.view()), 0, "the same picture on another device");
}

#[test]
fn input_to_paint_is_measured() {
    let mut window = Window::open("courtyard");
    window.0.set_render_every_step(true);
    let before = window.app().latency().count();
    for x in 0..5 {
        window.0.hover_at(window.view_rect().center() + vec2(x as f32, 0.0));
        window.0.step();
    }
    std::thread::sleep(Duration::from_millis(50));
    assert!(window.app().latency().count() > before);
    assert!(window.app().latency().p95_ms().is_some_and(|ms| ms > 0.0));
}

#[test]
fn real_files_open_by_drop() {
    let Some(folder) = real_scenes() else { return };
    let mut window = Window::open("courtyard");
    let courtyard = window.view();
    window.0.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(folder.join("Fox/Fox.glb"))));
    window.settle();
    assert_changed(&courtyard, &window.view(), "another scene");
    assert!(window.0.query_all_by_label("Fox").next().is_some());
    window.click("Ghost");
    assert_eq!(window.app().settings().method.look.view, View::Ghost);
}
