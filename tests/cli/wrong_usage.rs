//! What cannot be done says so in one sentence, with the exit code that tells why.

use std::ffi::OsStr;
use std::fs;

use crate::octolume;
use crate::scenes::Scenes;

/// Runs what must fail; standard error. Nothing may be on standard output.
fn fail<S: AsRef<OsStr>>(code: i32, arguments: impl IntoIterator<Item = S>) -> String {
    let output = octolume(arguments);
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(code), "{errors}");
    assert!(output.stdout.is_empty());
    errors
}

#[test]
fn a_missing_file_is_named() {
    let errors = fail(1, ["info", "nowhere/scene.glb"]);
    assert!(errors.starts_with("error: ") && errors.contains("nowhere/scene.glb"), "{errors}");
    assert_eq!(errors.lines().count(), 1, "{errors}");
}

#[test]
fn what_is_no_gltf_is_named() {
    let scenes = Scenes::new();
    for (name, content) in [("text.gltf", "hello"), ("text.glb", "hello"), ("empty.glb", ""), ("array.gltf", "[1]")] {
        let file = scenes.path(name);
        fs::write(&file, content).expect("written");
        let errors = fail(1, [OsStr::new("info"), file.as_os_str()]);
        assert!(errors.contains(name) && errors.lines().count() == 1, "{errors}");
    }
}

#[test]
fn a_folder_is_no_scene() {
    let scenes = Scenes::new();
    let errors = fail(1, [OsStr::new("info"), scenes.path("").as_os_str()]);
    assert!(errors.starts_with("error: "), "{errors}");
}

#[test]
fn values_out_of_range_name_the_range() {
    let cases: [(&[&str], &str); 18] = [
        (&["info", "courtyard", "--grid", "100"], "[64, 128, 256, 512, 1024]"),
        (&["info", "courtyard", "--span", "-1"], "a finite number above 0"),
        (&["info", "courtyard", "--span", "inf"], "finite number"),
        (&["info", "courtyard", "--dense-level", "10"], "0 to 9"),
        (&["info", "courtyard", "--grid", "64", "--dense-level", "6"], "0 to 5"),
        (&["info", "courtyard", "--filter", "both"], "`nearest` or `split`"),
        (&["info", "courtyard", "--time", "-1"], "from 0"),
        (&["render", "courtyard", "-o", "x.png", "--size", "0x10"], "1 to 8192"),
        (&["render", "courtyard", "-o", "x.png", "--view", "level:9"], "0 (the root) to 7"),
        (&["render", "courtyard", "-o", "x.png", "--eye", "1,2,3", "--target", "1,2,3"], "must differ"),
        (&["render", "courtyard", "-o", "x.png", "--eye", "1,2,3", "--target", "0,0,0", "--fov", "180"], "1 to 170"),
        (&["bench", "courtyard", "--runs", "0"], "1..=10000"),
        (&["info", "courtyard", "--fit", "all"], "scene, clip, pose, selection or a box"),
        (&["info", "courtyard", "--fit", "0,0,0:1,1"], "scene, clip, pose, selection or a box"),
        (&["info", "courtyard", "--fit", "0,0,0:1,0,1"], "no finite extent along each axis"),
        (&["render", "courtyard", "-o", "x.jpg"], "x.jpg ends in neither .png nor .exr"),
        (&["render", "courtyard", "-o", "x"], "ends in neither .png nor .exr"),
        (&["render", "courtyard", "-o", "-", "--frames", "0:1", "--fps", "1"], "frames need a file each"),
    ];
    for (arguments, range) in cases {
        let errors = fail(2, arguments);
        assert!(errors.contains(range), "{arguments:?}: {errors}");
    }
}

#[test]
fn wrong_options_are_wrong_usage() {
    let cases: [&[&str]; 8] = [
        &["info"],
        &["info", "courtyard", "--nonsense"],
        &["render", "courtyard"],
        &["render", "courtyard", "-o", "x.png", "--eye", "1,2,3"],
        &["render", "courtyard", "-o", "x.png", "--frames", "0:3"],
        &["render", "courtyard", "-o", "x.png", "--frames", "0:3", "--fps", "24", "--time", "1"],
        &["voxels", "courtyard", "-o", "x.obj"],
        &["make", "cathedral", "-o", "x.glb"],
    ];
    for arguments in cases {
        fail(2, arguments);
    }
}

#[test]
fn characters_are_counted_where_there_are_some() {
    for arguments in [["courtyard", "2"], ["dynamic", "0"], ["dynamic", "257"]] {
        let [scene, count] = arguments;
        let said = fail(2, ["make", scene, "-o", "unwritten.glb", "--characters", count]);
        assert!(said.contains("--characters"), "{said}");
    }
}

#[test]
fn an_unknown_adapter_is_named_beside_those_there_are() {
    let errors = fail(1, ["info", "courtyard", "--adapter", "Voodoo 2"]);
    assert!(errors.contains("Voodoo 2"), "{errors}");
}

#[test]
fn an_unknown_clip_is_named_beside_those_there_are() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let errors = fail(1, [OsStr::new("info"), scene.as_os_str(), OsStr::new("--clip"), OsStr::new("Walk")]);
    assert!(errors.contains("\"Walk\"") && errors.contains("\"Turn\""), "{errors}");
}

#[test]
fn what_cannot_be_written_is_named() {
    let errors = fail(1, ["make", "courtyard", "-o", "nowhere/courtyard.glb"]);
    assert!(errors.contains("nowhere/courtyard.glb"), "{errors}");
}

#[test]
fn bad_settings_are_named() {
    let scenes = Scenes::new();
    let file = scenes.path("settings.json");
    fs::write(&file, r#"{"look": {"colour": "albedo"}}"#).expect("written");
    let errors = fail(1, [OsStr::new("info"), OsStr::new("courtyard"), OsStr::new("--settings"), file.as_os_str()]);
    assert!(errors.contains("settings.json") && errors.contains("colour"), "{errors}");
}

#[test]
#[cfg(not(feature = "gui"))]
fn a_build_without_window_says_so() {
    let errors = fail(2, ["courtyard"]);
    assert!(errors.contains("no window"), "{errors}");
}
