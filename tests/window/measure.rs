//! Experiments beside the picture: started, watched, cancelled, listed and saved.

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use octolume::settings::NodeNames;
use serde_json::Value;

use crate::rig::{Window, difference, small_grid, wgpu_setup};

const CANCELLED: &str = "It was cancelled: rows are missing.";
const OF_ANOTHER: &str = "It is of another scene, moment or other settings than shown.";

/// The courtyard, and the panel unfolded.
fn window() -> Window {
    let mut window = Window::with(wgpu_setup(), "courtyard", small_grid(), NodeNames::default());
    ["Timings", "Octree", "Frame plan", "Measure"].into_iter().for_each(|section| window.click(section));
    assert_eq!(window.count("Nothing is measured yet."), 1);
    window.set("Runs", 1.0);
    window
}

#[test]
fn an_experiment_tells_how_far_it_is_and_is_cancelled() {
    let mut window = window();
    let before = window.view();
    window.choose("Measured", "Lit surfaces");
    window.0.get_by_label("Start").click();
    window.0.run_steps(4);
    assert!(!window.app().is_settled(), "it goes on");
    assert!(window.0.query_by_role(Role::ProgressIndicator).is_some() && window.0.query_by_label("Start").is_none());
    window.click("Cancel");
    assert_eq!(window.count(CANCELLED), 1);
    assert!(window.0.query_by_label("Start").is_some() && window.0.query_by_role(Role::ProgressIndicator).is_none());
    assert_eq!(difference(&before, &window.view()), 0, "the picture is none of its business");
}

#[test]
fn a_finished_experiment_is_listed_and_saved_and_told_from_another_moment() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window();
    window.type_into("Save to", &folder.path().display().to_string());
    window.choose("Measured", "Holes and spill");
    window.click("Start");
    for head in ["exact cells", "nearest holes %", "split spill %"] {
        assert_eq!(window.count(head), 1, "{head}");
    }
    assert_eq!((window.count(CANCELLED), window.count(OF_ANOTHER)), (0, 0));
    window.click("Save JSON");
    let file = folder.path().join("octolume-courtyard-voxels-1.json");
    let report: Value = serde_json::from_str(&std::fs::read_to_string(file).expect("a file")).expect("JSON");
    assert_eq!((&report["experiment"], report["rows"].as_array().map(Vec::len)), (&"voxels".into(), Some(1)));
    window.click("Slice");
    assert_eq!(window.count(OF_ANOTHER), 0, "another view");
    window.set("Turn y", 10.0);
    assert_eq!(window.count(OF_ANOTHER), 1, "another pose");
    window.set("Turn y", 0.0);
    assert_eq!(window.count(OF_ANOTHER), 0);
}

#[test]
fn both_discretizers_are_measured_on_the_moment_shown() {
    let mut window = window();
    window.choose("Measured", "Discretizers");
    window.click("Start");
    for text in ["discretize ms", "× transform", "transform, split", "voxelize, sparse", "voxelize, dense"] {
        assert_eq!(window.count(text), 1, "{text}");
    }
    window.choose("Discretizer", "Voxelize");
    assert_eq!(window.count(OF_ANOTHER), 0, "both are measured, whichever is shown");
}
