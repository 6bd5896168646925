//! Controls that change the picture, shown to change pixels.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use octolume::scene::builtin;
use octolume::settings::{FitTo, NodeNames, Settings};

use crate::rig::{Window, assert_changed, difference, wgpu_setup};

#[test]
fn every_control_of_the_picture_changes_pixels_and_back() {
    let mut window = Window::open("courtyard");
    let first = window.view();
    let colors: std::collections::HashSet<_> = first.pixels().collect();
    assert!(colors.len() > 50, "the view shows {} colours", colors.len());
    for (there, back) in [
        ("Nearest", "Split"),
        ("Mesh", "Voxels"),
        ("Ghost", "Voxels"),
        ("By length", "Per voxel"),
        ("Shaded", "Shaded"),
        ("Voxel edges", "Voxel edges"),
    ] {
        let before = window.view();
        window.click(there);
        assert_changed(&before, &window.view(), there);
        window.click(back);
        assert_eq!(difference(&before, &window.view()), 0, "{back} brings the picture back");
    }
    window.set("Turn y", 30.0);
    let turned = window.view();
    for (list, there, back) in [("Anchor", "Corner", "Centre"), ("Discretizer", "Voxelize", "Transform")] {
        window.choose(list, there);
        assert_changed(&turned, &window.view(), there);
        window.choose(list, back);
        assert_eq!(difference(&turned, &window.view()), 0, "{back} brings the picture back");
    }
    window.set("Turn y", 0.0);
    assert_eq!(difference(&first, &window.view()), 0, "turning back brings the picture back");
}

#[test]
fn levels_colours_and_grids_change_the_picture() {
    let mut window = Window::open("courtyard");
    let mut before = window.view();
    for (level, name) in [(5.0, "level 5"), (2.0, "level 2"), (6.0, "leaves")] {
        window.set("Level", level);
        let after = window.view();
        assert_changed(&before, &after, name);
        before = after;
    }
    for color in ["Normal", "Occupancy", "Object", "Octree level", "Albedo"] {
        window.choose("Colour", color);
        let after = window.view();
        assert_changed(&before, &after, color);
        before = after;
    }
    window.choose("Grid", "128³ cells");
    assert_changed(&before, &window.view(), "another grid");
    assert_eq!(window.app().settings().method.discretization.grid, 128);
}

#[test]
fn the_timeline_moves_the_scene_and_scrubbing_returns_to_the_same_picture() {
    let mut window = Window::open("courtyard");
    let start = window.view();
    (0..6).for_each(|_| window.click("Step forward"));
    let stepped = window.view();
    assert_changed(&start, &stepped, "stepping");
    window.set("Time", 0.0);
    assert_eq!(difference(&start, &window.view()), 0, "time 0 looks the same again");
    window.set("Time", 0.2);

    assert_eq!(difference(&stepped, &window.view()), 0, "scrubbed to the time stepped to");
    window.choose("Clip", "Rest pose");
    assert_eq!(window.app().settings().shot.motion.clip.as_deref(), Some(""));

    window.choose("Clip", "walk (10.00 s)");
    window.0.get_by_label("Play").click();
    window.0.run_steps(8);
    window.0.get_by_label("Pause").click();
    window.settle();
    assert!(window.app().settings().shot.motion.time_secs > 0.0);
    window.press(Modifiers::NONE, Key::ArrowLeft);
    let thirtieths = window.app().settings().shot.motion.time_secs * 30.0;
    assert!((thirtieths - thirtieths.round()).abs() < 1e-9, "a step lands on a thirtieth");
}

#[test]
fn what_does_not_fit_a_smaller_grid_is_told() {
    let mut settings = Settings::default();
    (settings.method.look.level, settings.method.discretization.dense_level) = (Some(7), Some(6));
    let mut window = Window::with(wgpu_setup(), "courtyard", settings, NodeNames::default());
    let level = "level 7 is not one of 0 (the root) to 6 (the leaves): the leaves are shown";
    let dense = "dense level 6 does not fit a grid of 64 cells";
    assert_eq!([window.log_count(level), window.log_count(dense)], [0, 0]);
    window.choose("Grid", "64³ cells");
    assert_eq!([window.log_count(level), window.log_count(dense)], [1, 1]);
}

#[test]
fn the_grid_is_fit_to_the_pose_and_to_a_selected_node() {
    let mut window = Window::open("courtyard");
    window.choose("Fit to", "Pose");
    assert_eq!(window.app().settings().shot.fit.to, FitTo::Pose);
    window.open_tree();
    window.type_into("Find", "TRAVELLER");
    window.select("traveller");
    let before = window.view();
    window.choose("Nodes that count", "the selected node");
    assert_eq!(window.app().settings().shot.fit.counted.only.len(), 1);
    assert_changed(&before, &window.view(), "the grid of one node");
}

/// A heart whose joints scale comes apart where its voxels are moved; the facts of its node say so.
#[test]
fn what_stretches_is_voxelized_or_moved() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("elastic.glb");
    std::fs::write(&file, builtin::make("elastic", 1).expect("a known name").expect("is made")).expect("written");
    let mut window = Window::open(&file.display().to_string());
    window.set("Time", 0.5);
    let voxelized = window.view();
    window.choose("Stretching objects", "Moved");
    assert_changed(&voxelized, &window.view(), "moved");
    assert!(window.log_holds("its moved voxels leave its surface"));
    let blended = window.view();
    window.choose("Joint weights", "Flat");
    assert_changed(&blended, &window.view(), "flat weights");
    window.choose("Joint weights", "Smooth");
    assert_eq!(difference(&blended, &window.view()), 0, "blending brings the picture back");
    window.choose("Stretching objects", "Voxelized");
    assert_eq!(difference(&voxelized, &window.view()), 0, "voxelizing brings the picture back");
    window.open_tree();
    window.select("ball");
    let told = window.0.query_all_by_label_contains("has morph targets that move it by up to").count();
    assert_eq!(told, 1);
}
