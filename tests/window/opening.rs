//! Scenes that come, do not come, or are not waited for; and windows of odd sizes.

use std::path::{Path, PathBuf};

use egui::vec2;
use egui_kittest::kittest::Queryable as _;
use octolume::export::read_settings;
use serde_json::{Value, json};

use crate::files::{Dropped, write};
use crate::rig::{Window, assert_changed, difference};

impl Window {
    fn drop_file(&mut self, file: PathBuf) {
        self.0.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(file)));
    }

    /// The same, until it is open.
    fn open_by_drop(&mut self, file: PathBuf) {
        self.drop_file(file);
        self.0.step();
        self.settle();
        self.outlast_notes();
    }

    /// Cancels what is going on as soon as the window offers to, which it does within a few frames.
    fn cancel_at_once(&mut self) {
        for _ in 0..10 {
            if self.0.query_by_label("Cancel").is_none() {
                self.0.step();
            }
        }
        self.click("Cancel");
    }
}

/// The same triangle so many times.
fn slow_file(folder: &Path, triangles: usize) -> PathBuf {
    let indices = 3 * triangles;
    let file = write(folder, "slow", &[0], vec![json!({ "mesh": 0 })], None);
    let mut document: Value = serde_json::from_slice(&std::fs::read(&file).expect("read")).expect("JSON");
    let add = |document: &mut Value, list: &str, item: Value| document[list].as_array_mut().expect("a list").push(item);
    add(&mut document, "buffers", json!({ "byteLength": indices, "uri": "indices.bin" }));
    add(&mut document, "bufferViews", json!({ "buffer": 1, "byteLength": indices }));
    add(
        &mut document,
        "accessors",
        json!({ "bufferView": 1, "componentType": 5121, "count": indices, "type": "SCALAR" }),
    );
    document["meshes"][0]["primitives"][0]["indices"] = json!(1);
    std::fs::write(folder.join("indices.bin"), [0, 1, 2].repeat(triangles)).expect("written");
    std::fs::write(&file, document.to_string()).expect("written");
    file
}

#[test]
fn a_broken_file_is_told_in_a_note_and_the_log_and_the_scene_before_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("broken.glb");
    std::fs::write(&file, b"glTF, but not really").expect("written");
    let mut window = Window::open("courtyard");
    let before = window.view();
    window.drop_file(file);
    window.settle();
    assert_changed(&before, &window.view(), "the note over the view");
    window.outlast_notes();
    assert_eq!(difference(&before, &window.view()), 0, "the scene before");
    assert!(window.0.query_all_by_label("courtyard").next().is_some());
    assert_eq!(window.log_count("broken.glb"), 1, "one sentence that names the file");
}

#[test]
fn cancelling_a_voxelization_keeps_the_voxels_that_are_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open(&slow_file(folder.path(), 60).display().to_string());
    window.outlast_notes();
    let before = window.view();
    window.click("Grid");
    window.0.get_by_label("1024³ cells").click();
    window.0.step();
    window.cancel_at_once();
    assert_eq!(window.app().settings().method.discretization.grid, 64);
    window.outlast_notes();
    assert_eq!(difference(&before, &window.view()), 0);
    assert_eq!(window.log_count("Cancelled."), 1);
}

#[test]
fn cancelling_a_large_file_keeps_the_scene_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("courtyard");
    let before = window.view();
    window.drop_file(slow_file(folder.path(), 1_000_000));
    window.0.step();
    window.cancel_at_once();
    assert_eq!(difference(&before, &window.view()), 0);
    assert!(window.0.query_all_by_label("courtyard").next().is_some());
    assert_eq!(window.log_count("Cancelled."), 1);
}

#[test]
fn a_view_without_room_is_left_empty_and_comes_back() {
    let mut window = Window::open("courtyard");
    for size in [vec2(10.0, 1000.0), vec2(1000.0, 60.0), vec2(1.0, 1.0)] {
        window.0.set_size(size);
        window.settle();
        let rect = window.view_rect();
        assert!(rect.width() < 20.0 || rect.height() < 20.0, "{size}: {rect}");
    }
    window.0.set_size(vec2(1000.0, 1000.0));
    window.settle();
    let view = window.view();
    assert!(view.pixels().collect::<std::collections::HashSet<_>>().len() > 50, "a picture again");
}

#[test]
fn another_scale_factor_draws_as_many_pixels_as_the_screen_has() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("courtyard");
    window.type_into("Save to", &folder.path().display().to_string());
    for (scale, number) in [(2.0, 1), (0.5, 2), (1.25, 3)] {
        window.0.set_pixels_per_point(scale);
        window.settle();
        window.press(egui::Modifiers::COMMAND, egui::Key::S);
        let size = window.view_rect().size() * scale;
        let file = folder.path().join(format!("octolume-courtyard-{number}.png"));
        let size_px = read_settings(&file).expect("a picture").shot.size_px;
        assert_eq!(size_px, Some([size.x, size.y].map(|edge| edge.round() as u32)), "{scale}");
    }
}

#[test]
fn of_several_scenes_in_a_file_another_can_be_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = vec![json!({ "mesh": 0 }), json!({ "mesh": 0, "rotation": [0.0, 0.6, 0.0, 0.8] })];
    let file = write(folder.path(), "scenes", &[0, 1], nodes, None);
    let mut document: Value = serde_json::from_slice(&std::fs::read(&file).expect("read")).expect("JSON");
    document["scenes"] = json!([{ "name": "day", "nodes": [0] }, { "name": "night", "nodes": [1] }]);
    std::fs::write(&file, document.to_string()).expect("written");
    let mut window = Window::open(&file.display().to_string());
    assert_eq!(window.log_count("\"day\" is shown"), 1);
    window.outlast_notes();
    let day = window.view();
    window.click("Shown");
    window.0.get_by_label("night").click();
    window.0.step();
    window.settle();
    window.outlast_notes();
    assert_changed(&day, &window.view(), "the other scene");
    assert_eq!(window.log_count("Opened scenes"), 2);
}

#[test]
fn a_picture_that_is_dropped_brings_back_scene_and_settings() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = write(folder.path(), "flight", &[0], vec![json!({ "mesh": 0 })], Some([[0.0; 3], [1.0, 0.5, 0.0]]));
    let mut window = Window::open(&file.display().to_string());
    window.type_into("Save to", &folder.path().display().to_string());
    window.click("Nearest");
    window.set("Level", 5.0);
    window.click("Screenshot");
    let picture = folder.path().join("octolume-flight-1.png");
    let saved = read_settings(&picture).expect("settings in the picture");
    window.click("Split");
    window.open_by_drop(picture.clone());
    assert_eq!(window.app().settings().method, saved.method, "the scene is open: its settings come back");
    // From another scene, and without the file where it was.
    window.open_by_drop("courtyard".into());
    let elsewhere = folder.path().join("elsewhere");
    std::fs::create_dir(&elsewhere).expect("made");
    for name in ["flight.gltf", "flight.bin"] {
        std::fs::rename(folder.path().join(name), elsewhere.join(name)).expect("moved");
    }
    window.open_by_drop(picture.clone());
    assert!(window.log_holds("which is not there: the next scene opened gets its settings"));
    window.open_by_drop(elsewhere.join("flight.gltf"));
    assert_eq!(window.app().settings().method, saved.method);
    assert_eq!(window.app().settings().shot.camera, saved.shot.camera);
    // Beside the picture it is found without being asked for.
    let moved = elsewhere.join("shot.png");
    std::fs::rename(&picture, &moved).expect("moved");
    window.open_by_drop("courtyard".into());
    window.open_by_drop(moved);
    assert_eq!(window.app().settings().method, saved.method);
    assert_eq!(window.log_count("Everything is as in"), 3);
}
