//! `--hide` and `--only`: nodes by name, for every subcommand.

use std::fs;

use image::RgbaImage;
use serde_json::Value;

use crate::scenes::Scenes;
use crate::{json, octolume, on_small_grid, succeed};

/// Occupied leaves.
fn leaves(options: &[&str]) -> u64 {
    let info = json(["info", "courtyard", "--json"].iter().chain(options));
    let levels = info["levels"].as_array().expect("a list");
    levels.last().map_or(0, |leaf| leaf["occupied"].as_u64().expect("a number"))
}

#[test]
fn hidden_nodes_are_not_in_the_octree() {
    let all = leaves(&[]);
    let hidden = leaves(&["--hide", "walls", "--hide", "roofs"]);
    let only = leaves(&["--only", "walls", "--only", "roofs"]);
    assert!(hidden < all && only < all && hidden + only >= all, "{hidden} {only} {all}");
    assert_eq!(leaves(&["--only", "walls", "--hide", "walls"]), 0, "hidden counts more than shown alone");
}

#[test]
fn where_everything_is_hidden_no_pass_runs_and_the_picture_is_background() {
    let scenes = Scenes::new();
    let box_ = scenes.still_box();
    let scene = box_.to_str().expect("UTF-8");
    let plan = json(["plan", scene, "--json", "--hide", "Crate"]);
    let skipped = |row: &Value| row["state"] == "skip" && row["reason"] != "";
    assert!(plan.as_array().expect("a list").iter().all(skipped), "{plan}");
    let file = scenes.path("empty.png");
    succeed(["render", scene, "--hide", "Crate", "--size", "8x6", "-o", file.to_str().expect("UTF-8")]);
    let picture: RgbaImage = image::open(file).expect("a picture").to_rgba8();
    assert_eq!(picture.dimensions(), (8, 6));
    assert!(picture.pixels().all(|pixel| pixel == picture.get_pixel(0, 0)));
}

#[test]
fn a_picture_remembers_what_was_hidden() {
    let scenes = Scenes::new();
    let file = |name: &str| scenes.path(name).to_str().expect("UTF-8").to_owned();
    let [first, again] = [file("first.png"), file("again.png")];
    let size = ["--size", "64x48"];
    succeed(["render", "courtyard", "--only", "colonnade", "-o", &first].iter().chain(&size));
    succeed(["render", "courtyard", "--settings", &first, "-o", &again]);
    assert_eq!(fs::read(&first).expect("a picture"), fs::read(&again).expect("a picture"));
    let all = file("all.png");
    succeed(["render", "courtyard", "-o", &all].iter().chain(&size));
    assert_ne!(fs::read(&first).expect("a picture"), fs::read(&all).expect("a picture"));
}

#[test]
fn names_that_are_not_there_are_named_and_shared_ones_are_told() {
    let scenes = Scenes::new();
    for (options, cause) in [
        (["--hide", "Walls"], "no node called \"Walls\""),
        (["--only", "wals"], "no node called \"wals\""),
        (["--only", "sun"], "nothing of \"sun\" can be shown"),
    ] {
        let output = octolume(["info", "courtyard"].iter().chain(&options));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.contains(cause) && errors.lines().count() == 1, "{errors}");
    }
    // Settings of another scene.
    let file = scenes.path("settings.json");
    fs::write(&file, r#"{"visibility": {"hidden": [7]}}"#).expect("written");
    let scene = scenes.still_box();
    let output = octolume(["info".as_ref(), scene.as_os_str(), "--settings".as_ref(), file.as_os_str()]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && errors.contains("node 7") && errors.contains("0 to 0"), "{errors}");

    let output = on_small_grid(["info".as_ref(), scenes.twins().as_os_str(), "--hide".as_ref(), "Twin".as_ref()]);
    let warnings = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && warnings.contains("2 nodes are called \"Twin\"; all of them are hidden"),
        "{warnings}"
    );
}
