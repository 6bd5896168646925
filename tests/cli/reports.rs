//! What `info`, `plan`, `bench` and `accuracy` print, field by field.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use octolume::digest::Digest;
use octolume::settings::{FORMAT, Settings};
use serde_json::{Value, json};

use crate::scenes::{BOX_TRIANGLES, Scenes, TURN_SECS};
use crate::{fields, json, succeed};

fn report(command: &str, scene: &OsStr, options: &[&str]) -> Value {
    let start = [OsStr::new(command), scene, OsStr::new("--json")];
    json(start.into_iter().chain(options.iter().map(OsStr::new)))
}

#[test]
fn info_counts_what_is_there() {
    let scenes = Scenes::new();
    let info = report("info", scenes.turning_box().as_os_str(), &["--span", "0.125"]);
    assert_eq!(info["name"], "box");
    assert_eq!(info["triangles"], BOX_TRIANGLES);
    assert_eq!((&info["objects"], &info["skins"], &info["joints"]), (&json!(1), &json!(0), &json!(0)));
    assert_eq!(info["clips"], json!([{ "name": "Turn", "seconds": TURN_SECS }]));
    assert_eq!((&info["extensions"], &info["warnings"]), (&json!([]), &json!([])));
    assert_eq!((&info["grid"], &info["span"]), (&json!(64), &json!(0.125)));
    let levels = info["levels"].as_array().expect("a list");
    assert_eq!(levels.len(), 7);
    for (level, report) in levels.iter().enumerate() {
        assert_eq!(fields(report), ["bytes", "dummies", "level", "nodes", "occupied"]);
        assert_eq!(report["level"], level);
    }
    assert_eq!((&levels[0]["nodes"], &levels[0]["occupied"]), (&json!(1), &json!(1)));
}

#[test]
fn info_of_a_skin_counts_its_joints() {
    let scenes = Scenes::new();
    let info = report("info", scenes.bent_box().as_os_str(), &[]);
    assert_eq!((&info["skins"], &info["joints"], &info["triangles"]), (&json!(1), &json!(2), &json!(BOX_TRIANGLES)));
}

#[test]
fn info_reads_well_without_json() {
    let scenes = Scenes::new();
    let text = succeed([OsStr::new("info"), scenes.turning_box().as_os_str()]);
    assert!(text.contains("box: 12 triangles, 1 object\n") && text.contains("clip \"Turn\", 2.000 s"), "{text}");
}

/// State of every pass.
fn states(plan: &Value) -> Vec<(String, String)> {
    let text = |value: &Value| value.as_str().expect("text").to_owned();
    let row = |row: &Value| {
        assert_eq!(fields(row), ["method", "pass", "reason", "state"]);
        assert!(!text(&row["reason"]).is_empty());
        (text(&row["pass"]), text(&row["state"]))
    };
    plan.as_array().expect("a list").iter().map(row).collect()
}

fn running(plan: &Value) -> Vec<String> {
    states(plan).into_iter().filter(|(_, state)| state == "run").map(|(pass, _)| pass).collect()
}

#[test]
fn the_first_frame_of_a_rigid_scene_needs_no_skin() {
    let scenes = Scenes::new();
    let plan = report("plan", scenes.turning_box().as_os_str(), &[]);
    let states = states(&plan);
    assert!(states.contains(&("transform-skinned".to_owned(), "skip".to_owned())));
    assert!(states.contains(&("transform-rigid".to_owned(), "run".to_owned())));
    assert!(states.contains(&("gather-nearest".to_owned(), "skip".to_owned())));
    assert!(states.contains(&("march-voxels".to_owned(), "run".to_owned())));
}

#[test]
fn a_second_frame_does_only_what_changed() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let after = |change| running(&report("plan", scene.as_os_str(), &["--after", change]));
    assert_eq!(after("still"), [""; 0]);
    assert_eq!(after("camera"), ["march-voxels"]);
    let moved = after("time");
    assert!(moved.contains(&"transform-rigid".to_owned()) && !moved.contains(&"upload-caches".to_owned()));
    let filtered = after("filter");
    assert!(filtered.contains(&"gather-nearest".to_owned()) && !filtered.contains(&"transform-rigid".to_owned()));
}

#[test]
fn another_light_is_injected_and_averaged_alone() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let plan = |options: &[&str]| running(&report("plan", scene.as_os_str(), options));
    let first = plan(&["--view", "radiance"]);
    assert!(first.contains(&"draw-shadows".to_owned()) && first.contains(&"march-light".to_owned()), "{first:?}");
    let ran = ["illuminate", "inject-light", "average-light", "march-light"];
    assert_eq!(plan(&["--view", "radiance", "--after", "light"]), ran);
    assert_eq!(plan(&["--after", "light"]), [""; 0], "nobody looks at it");
}

#[test]
fn bench_measures_light_by_variant_where_asked() {
    let scenes = Scenes::new();
    let options = ["--warmup", "0", "--runs", "1", "--lighting"];
    let bench = report("bench", scenes.turning_box().as_os_str(), &options);
    let light = &bench["light"];
    let passes: Vec<&str> =
        light["passes"].as_array().expect("a list").iter().filter_map(|p| p["kernel"].as_str()).collect();
    for kernel in ["build/link, pointers a node", "light/illuminate, marched shadows", "light/gather, a bounce"] {
        assert!(passes.contains(&kernel), "{passes:?}");
    }
    assert_eq!(light["sampling"].as_array().expect("a list").len(), 18);
    assert!(light["memory"]["bytes_per_node"].as_f64().is_some_and(|bytes| bytes > 0.0));
}

#[test]
fn plan_reads_well_without_json() {
    let scenes = Scenes::new();
    let plan = |stretching: &str| {
        succeed([OsStr::new("plan"), scenes.bent_box().as_os_str(), OsStr::new("--stretching"), OsStr::new(stretching)])
    };
    let (moved, voxelized) = (plan("move"), plan("voxelize"));
    assert!(moved.contains("| transform-rigid") && moved.contains("no rigid object in the grid"), "{moved}");
    assert!(voxelized.contains("every object stretches, and is voxelized"), "{voxelized}");
    assert!(voxelized.contains("voxelized every frame: \"Sleeve\" stretches by up to "), "{voxelized}");
}

#[test]
fn bench_measures_every_kernel_beside_a_copy() {
    let scenes = Scenes::new();
    let bench = report("bench", scenes.turning_box().as_os_str(), &["--warmup", "1", "--runs", "3"]);
    let cost = ["bytes", "floor_ms", "gb_per_s", "kernel", "median_ms", "p5_ms", "p95_ms", "ratio"];
    let kernels = bench["kernels"].as_array().expect("a list");
    for kernel in kernels.iter().chain([&bench["copy"], &bench["rebuild"]]) {
        assert_eq!(fields(kernel), cost);
        let ms = |name| kernel[name].as_f64().expect("a number");
        assert!(ms("p5_ms") <= ms("median_ms") && ms("median_ms") <= ms("p95_ms"), "{kernel}");
    }
    let names: Vec<&str> = kernels.iter().filter_map(|kernel| kernel["kernel"].as_str()).collect();
    for name in ["transform/rigid", "build/mark", "build/emit", "fill/gather", "averaging/average", "view/march"] {
        assert!(names.contains(&name), "{name} is not in {names:?}");
    }
    assert_eq!((&bench["runs"], &bench["scene"]), (&json!(3), &json!("box")));
    for text in ["adapter", "driver", "date", "octolume", "experiment"] {
        assert!(bench[text].as_str().is_some_and(|text| !text.is_empty()), "{text}");
    }
}

#[test]
fn accuracy_compares_both_filters_in_every_pose() {
    let scenes = Scenes::new();
    let folder = scenes.path("accuracy");
    let folder = folder.to_str().expect("UTF-8");
    let scene = scenes.turning_box();
    let found = report("accuracy", scene.as_os_str(), &["--times", "0,0.7", "--grids", "64,128", "-o", folder]);
    assert_eq!(fields(&found), ["adapter", "date", "driver", "experiment", "octolume", "rows", "settings"]);
    let settings = Settings::from_json(&found["settings"].to_string()).expect("settings that open");
    let of = settings.shot.scene.expect("the scene is told");
    let bytes = fs::read(&scene).expect("the scene");
    assert_eq!((Path::new(&of.source), of.digest), (&*scene, Some(Digest::of_file(&bytes))));
    assert_eq!(
        (&found["settings"]["format"], &found["settings"]["shot"]["size_px"]),
        (&json!(FORMAT), &json!([960, 540]))
    );
    let rows = found["rows"].as_array().expect("a list");
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert_eq!((&row["scene"], &row["clip"]), (&json!("box"), &json!("Turn")));
        for filter in ["nearest", "split"] {
            for number in ["kernel_ms", "voxels", "leaves", "nodes", "bytes", "holes", "spill"] {
                assert!(row[filter][number].is_number(), "{filter} {number}: {row}");
            }
        }
        // Split reaches every cell that nearest reaches.
        assert!(row["split"]["holes"].as_u64() <= row["nearest"]["holes"].as_u64(), "{row}");
    }
    assert_eq!((&rows[0]["grid"], &rows[3]["grid"]), (&json!(64), &json!(128)));
    let kept = fs::read_to_string(scenes.path("accuracy").join("accuracy.json")).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&kept).expect("JSON"), found, "what is printed is kept");
    let files = ["accuracy.csv", "accuracy.md", "box-64-0-nearest.png", "box-128-1-split.png"];
    for file in files {
        assert!(scenes.path("accuracy").join(file).is_file(), "{file}");
    }
}

#[test]
fn accuracy_compares_the_shadows_of_every_light() {
    let scenes = Scenes::new();
    let folder = scenes.path("shadows");
    let folder = folder.to_str().expect("UTF-8");
    let scene = scenes.turning_box();
    let bulb = "point:at=1,5,3:name=bulb";
    let options = ["--lighting", "--runs", "1", "--sun", "500", "--add-light", bulb, "-o", folder];
    let found = report("accuracy", scene.as_os_str(), &options);
    assert_eq!(found["experiment"], "shadows");
    let rows = found["rows"].as_array().expect("a list");
    let names: Vec<[&Value; 3]> = rows.iter().map(|row| [&row["light"], &row["shadows"], &row["map_px"]]).collect();
    let methods = [
        ("map", json!(1024)),
        ("map", json!(2048)),
        ("map", json!(4096)),
        ("march", json!(null)),
        ("off", json!(null)),
    ];
    let expected =
        ["sun", "bulb", "all"].map(|light| methods.clone().map(|(shadows, px)| [json!(light), json!(shadows), px]));
    assert_eq!(names, expected.as_flattened().iter().map(|row| row.each_ref()).collect::<Vec<_>>());
    for row in rows {
        assert_eq!((&row["scene"], &row["grid"], &row["time_secs"]), (&json!("box"), &json!(64), &json!(0.0)));
        let number = |name: &str| row[name].as_f64().unwrap_or_else(|| panic!("{name}: {row}"));
        assert!(number("kernel_ms") > 0.0 && number("points") > 1000.0 && number("open_lux") > 0.0, "{row}");
        for name in ["lit_percent", "mean_error_percent", "lost_percent", "leaked_percent"] {
            assert!((0.0..=100.0).contains(&number(name)), "{name}: {row}");
        }
        // Nothing is beside a box that could throw a shadow on it.
        assert_eq!(row["lit_percent"], 100.0, "{row}");
    }
    let table = fs::read_to_string(scenes.path("shadows").join("shadows.md")).expect("a table");
    let heads: Vec<&str> = table.lines().next().unwrap_or_default().split('|').map(str::trim).collect();
    let [.., points, lit, error, lost, leaked, _] = heads[..] else { panic!("{table}") };
    assert_eq!([points, lit, error, lost, leaked], ["points", "lit %", "mean error %", "lost %", "leaked %"]);
    assert_eq!(
        (heads[1..8].join(", ").as_str(), table.lines().count()),
        ("scene, time s, turn °, grid, light, shadows, kernel ms", 17)
    );
    assert_eq!(fs::read_to_string(scenes.path("shadows").join("shadows.csv")).expect("a table").lines().count(), 16);
}
