//! What `render` draws, and that a picture is enough to draw it again.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use image::RgbaImage;

use crate::scenes::Scenes;
use crate::succeed;

fn render(scene: &Path, file: &Path, options: &[&str]) -> Vec<u8> {
    let start = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o"), file.as_os_str()];
    let output = succeed(start.into_iter().chain(options.iter().map(OsStr::new)));
    assert!(output.is_empty(), "standard output is for results: {output}");
    fs::read(file).expect("a picture")
}

fn picture(bytes: &[u8]) -> RgbaImage {
    image::load_from_memory(bytes).expect("a picture").to_rgba8()
}

/// Pixels unlike the corner's, which is background.
fn drawn_pixels(picture: &RgbaImage) -> usize {
    picture.pixels().filter(|pixel| *pixel != picture.get_pixel(0, 0)).count()
}

#[test]
fn every_view_draws_the_scene() {
    let scenes = Scenes::new();
    let scene = scenes.bent_box();
    for view in ["voxels", "mesh", "ghost", "level:4"] {
        let bytes = render(&scene, &scenes.path("out.png"), &["--view", view, "--size", "80x60", "--time", "1"]);
        let picture = picture(&bytes);
        assert_eq!(picture.dimensions(), (80, 60));
        assert!(drawn_pixels(&picture) > 100, "{view}: {} pixels", drawn_pixels(&picture));
    }
}

#[test]
fn colours_time_and_camera_change_the_picture() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let looks: [&[&str]; 9] = [
        &[],
        &["--color", "normal"],
        &["--color", "occupancy"],
        &["--color", "object"],
        &["--color", "level"],
        &["--time", "1"],
        &["--turn", "0,20,0"],
        &["--eye", "9,2,1", "--target", "1,1.5,0.5", "--fov", "30"],
        &["--no-shading"],
    ];
    let draw = |look: &&[&str]| {
        let options: Vec<&str> = look.iter().copied().chain(["--size", "64x48"]).collect();
        picture(&render(&scene, &scenes.path("out.png"), &options)).into_raw()
    };
    let pictures: Vec<Vec<u8>> = looks.iter().map(draw).collect();
    for (index, look) in looks.iter().enumerate().skip(1) {
        assert!(pictures[index] != pictures[0], "{look:?} draws the same");
    }
}

#[test]
fn edges_show_where_cells_are_large() {
    let scenes = Scenes::new();
    let scene = scenes.still_box();
    let large = ["--span", "0.5", "--size", "160x120"];
    let plain = render(&scene, &scenes.path("plain.png"), &large);
    let edged = render(&scene, &scenes.path("edged.png"), &[&large[..], &["--edges"]].concat());
    assert!(picture(&plain) != picture(&edged));
}

#[test]
fn a_picture_draws_itself_again() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let first = scenes.path("first.png");
    let look = ["--color", "normal", "--filter", "nearest", "--time", "0.4", "--size", "72x50", "--alpha", "length"];
    let bytes = render(&scene, &first, &look);
    let again = render(&scene, &scenes.path("again.png"), &["--settings", first.to_str().expect("UTF-8")]);
    assert!(bytes == again, "the settings in a picture do not draw it again");
}

/// Written by the program of that format. Another driver may round a colour, or a voxel's border, the other way.
#[test]
fn a_picture_of_every_format_so_far_is_drawn_again() {
    // Pixels that may differ, of a hundred. Still instances have had voxels of their own since format 1: they no longer
    // lie up to half a cell beside their columns.
    const FORMATS: [(&str, usize); 2] = [("format-1", 2), ("format-2", 1)];
    let scenes = Scenes::new();
    let saved = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/saved");
    for (format, percent) in FORMATS {
        let before = saved.join(format).with_extension("png");
        let from = |file: &Path, size: &[&str]| {
            let settings = ["--settings", file.to_str().expect("UTF-8")];
            let options = [&settings[..], size].concat();
            picture(&render(Path::new("courtyard"), &scenes.path("again.png"), &options))
        };
        let again = from(&before, &[]);
        assert!(
            again == from(&before.with_extension("json"), &["--size", "96x54"]),
            "{format}: JSON and picture differ"
        );
        let before = image::open(&before).expect("a picture").to_rgba8();
        assert_eq!(again.dimensions(), before.dimensions());
        let is_off =
            |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 2);
        let off = again.pixels().zip(before.pixels()).filter(is_off).count();
        println!("{format}: {off} of {} pixels are off by more than 2 of 255", 96 * 54);
        assert!(off <= 96 * 54 * percent / 100, "{format}: {off} pixels");
    }
}

#[test]
fn frames_are_pictures_of_moments() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let small = ["--size", "48x32"];
    let start = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o")];
    let walk = scenes.path("walk.png");
    let options = ["--frames", "3:5", "--fps", "10", "--size", "48x32"].map(OsStr::new);
    succeed(start.into_iter().chain([walk.as_os_str()]).chain(options));
    assert!(!walk.exists() && !scenes.path("walk-0002.png").exists() && !scenes.path("walk-0006.png").exists());
    let fourth = fs::read(scenes.path("walk-0004.png")).expect("a frame");
    let moment = render(&scene, &scenes.path("moment.png"), &[&small[..], &["--time", "0.4"]].concat());
    assert!(fourth == moment, "frame 4 at 10 frames a second is the moment 0.4 s");
}

#[test]
fn standard_output_takes_the_same_bytes_as_a_file() {
    let scenes = Scenes::new();
    let scene = scenes.bent_box();
    let file = render(&scene, &scenes.path("out.png"), &["--size", "40x30"]);
    let start = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o"), OsStr::new("-")];
    let output = crate::on_small_grid(start.into_iter().chain(["--size", "40x30"].map(OsStr::new)));
    assert!(output.status.success() && output.stdout == file);
}

#[test]
fn a_grid_fits_what_it_is_told_to() {
    let scenes = Scenes::new();
    let scene = scenes.bent_box();
    let span = |options: &[&str]| {
        let start = [OsStr::new("info"), scene.as_os_str(), OsStr::new("--json")];
        let json = succeed(start.into_iter().chain(options.iter().map(OsStr::new)));
        serde_json::from_str::<serde_json::Value>(&json).expect("JSON")["span"].as_f64().expect("a number")
    };
    assert_eq!(span(&["--fit", "0,0,0:62,1,1"]), 1.0);
    let [pose, clip, all] = [["--fit", "pose"], ["--fit", "clip"], ["--fit", "scene"]].map(|options| span(&options));
    assert!(pose <= clip && clip <= all, "{pose} {clip} {all}");
}
