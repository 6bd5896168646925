//! The path tracer on the command line: pictures, and cones measured against them.

use std::fs;
use std::path::Path;
use std::process::Output;

use octolume::disk_cache::FOLDER_VARIABLE;
use serde_json::json;

use crate::scenes::Scenes;
use crate::{fields, json, octolume, program, small_grid};

fn traced(cache: &Path, scene: &Path, file: &Path, options: &[&str]) -> Output {
    let mut command = program();
    command.env(FOLDER_VARIABLE, cache).arg("render").arg(scene).arg("-o").arg(file);
    command.args(["--reference", "--size", "24x16"]).args(options).args(small_grid());
    command.output().expect("the program starts")
}

fn messages(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{text}");
    text
}

#[test]
fn a_traced_picture_is_the_same_with_and_without_a_pause() {
    let scenes = Scenes::new();
    let (scene, file, cache) = (scenes.still_box(), scenes.path("out.png"), scenes.path("kept"));
    let none = Path::new("");
    let whole = messages(&traced(none, &scene, &file, &["--samples", "6", "--sky", "1,1,1"]));
    assert!(whole.contains("6 samples a pixel in ") && whole.contains("standard error "), "{whole}");
    let bytes = fs::read(&file).expect("a picture");
    for samples in ["2", "6", "6"] {
        messages(&traced(&cache, &scene, &file, &["--samples", samples, "--sky", "1,1,1"]));
    }
    assert_eq!(fs::read(&file).expect("a picture"), bytes);
    messages(&traced(none, &scene, &file, &["--samples", "6", "--sky", "1,1,1", "--seed", "9"]));
    assert_ne!(fs::read(&file).expect("a picture"), bytes);
}

#[test]
fn every_term_is_traced_and_nothing_else() {
    let scenes = Scenes::new();
    let (scene, none) = (scenes.still_box(), Path::new(""));
    for view in ["final", "direct", "diffuse", "specular", "ao"] {
        for file in ["out.png", "out.exr"] {
            let options = ["--samples", "1", "--sky", "1,1,1", "--view", view];
            messages(&traced(none, &scene, &scenes.path(file), &options));
            let picture = image::open(scenes.path(file)).expect("a picture").into_rgb32f();
            assert_eq!(picture.dimensions(), (24, 16));
            // Of metal, which has no diffuse light.
            assert_eq!(picture.iter().any(|channel| *channel > 0.0), view != "diffuse", "{view}");
        }
    }
    for view in ["voxels", "mesh", "normal", "surfaces:irradiance"] {
        let refused = traced(none, &scene, &scenes.path("out.png"), &["--view", view]);
        let text = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{view}: {text}");
        assert!(text.contains("paths show --view final, direct, diffuse, specular or ao"), "{text}");
    }
    let alone = octolume(["render", "courtyard", "-o", "x.png", "--samples", "3"]);
    assert_eq!(alone.status.code(), Some(2));
}

#[test]
fn cones_are_compared_term_by_term() {
    let scenes = Scenes::new();
    let scene = scenes.still_box();
    let folder = scenes.path("compared");
    let start = [Path::new("accuracy"), &scene, Path::new("-o"), &folder].map(|part| part.as_os_str().to_owned());
    let options = ["--rendering", "--json", "--size", "32x24", "--samples", "8", "--runs", "1", "--sky", "1,1,1"];
    let found = json(start.into_iter().chain(options.map(Into::into)));
    let rows = found["rows"].as_array().expect("rows");
    let terms: Vec<&str> = rows.iter().filter_map(|row| row["term"].as_str()).collect();
    assert_eq!(terms, ["direct", "diffuse", "specular", "final", "ao"]);
    for row in rows {
        for name in ["rel_mse", "bias", "ssim", "cones_ms", "paths_secs", "paths_error"] {
            assert!(row[name].as_f64().is_some_and(f64::is_finite), "{name}: {row}");
        }
        assert_eq!((&row["size_px"], &row["samples"], &row["bounces"]), (&json!([32, 24]), &json!(8), &json!(0)));
        for kind in ["cones", "paths", "difference"] {
            let file = format!(
                "{}-64-0-{}-{kind}.png",
                row["scene"].as_str().unwrap_or_default(),
                row["term"].as_str().unwrap_or_default()
            );
            assert!(folder.join(&file).is_file(), "{file}");
        }
    }
    assert!(fields(&rows[3]).contains(&"flip") && folder.join("rendering.md").is_file());
}
