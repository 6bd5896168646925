//! Settings that do not fit the scene or the grid: a warning each, and once.

use std::ffi::OsStr;
use std::fs;

use crate::on_small_grid;
use crate::scenes::Scenes;

const DENSE: &str = "warning: dense level 8 does not fit a grid of 64 cells";
const SHADOWS: &str = "warning: shadow maps of 8192 texels along an edge would take";
const CLIP: &str = "warning: clip \"Turn\" ends at";

/// What a subcommand says on standard error of settings that fit neither clip, grid nor lights.
fn warnings(scenes: &Scenes, subcommand: &str, options: &[&OsStr]) -> String {
    let file = scenes.path("settings.json");
    let settings = r#"{"format": 2, "shot": {"motion": {"time_secs": 9}},
                       "method": {"discretization": {"dense_level": 8}, "lighting": {"shadow_map_px": 8192}}}"#;
    fs::write(&file, settings).expect("written");
    let scene = scenes.turning_box();
    let given = [OsStr::new(subcommand), scene.as_os_str(), OsStr::new("--settings"), file.as_os_str()];
    let bulb = ["--add-light", "point:at=1,5,3"].map(OsStr::new);
    let output = on_small_grid(given.into_iter().chain(bulb).chain(options.iter().copied()));
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(output.status.success(), "{errors}");
    errors
}

#[test]
fn a_plan_and_frames_tell_what_does_not_fit_once() {
    let scenes = Scenes::new();
    let view = ["--view", "radiance"].map(OsStr::new);
    let told = warnings(&scenes, "plan", &view);
    assert!([DENSE, SHADOWS, CLIP].iter().all(|sentence| told.contains(sentence)), "{told}");
    let file = scenes.path("walk.png");
    let frames = ["--frames", "90:92", "--fps", "10", "--size", "16x16"].map(OsStr::new);
    let output = [OsStr::new("-o"), file.as_os_str()];
    let told = warnings(&scenes, "render", &[&output[..], &frames, &view].concat());
    for sentence in [DENSE, SHADOWS, CLIP] {
        assert_eq!(told.matches(sentence).count(), 1, "{told}");
    }
    let light = ["--lighting", "--runs", "1"].map(OsStr::new);
    assert!(warnings(&scenes, "accuracy", &light).contains(CLIP));
}

#[test]
fn where_no_frame_is_planned_the_end_of_the_clip_is_told_too() {
    let scenes = Scenes::new();
    let (picture, voxels) = (scenes.path("paths.png"), scenes.path("exact.npz"));
    let paths = ["--reference", "--samples", "1", "--size", "8x8", "-o"].map(OsStr::new);
    let told = warnings(&scenes, "render", &[&paths[..], &[picture.as_os_str()]].concat());
    assert_eq!(told.matches(CLIP).count(), 1, "{told}");
    let exact = ["--source", "exact", "-o"].map(OsStr::new);
    let told = warnings(&scenes, "voxels", &[&exact[..], &[voxels.as_os_str()]].concat());
    assert_eq!(told.matches(CLIP).count(), 1, "{told}");
}
