//! What a picture is taken of: cameras of the file, how bright it is, what is seen of a single side, and dark colours.

use std::ffi::OsStr;
use std::path::Path;

use image::{Rgba, RgbaImage};
use serde_json::json;
use tempfile::TempDir;

use crate::files::{arrays, voxels};
use crate::walls::{banners, write};
use crate::{octolume, on_small_grid};

const RED: [f32; 3] = [1.0, 0.0, 0.0];
const GREEN: [f32; 3] = [0.0, 1.0, 0.0];

/// A picture, and what was told beside it.
fn render(scene: &Path, options: &[&str]) -> (RgbaImage, String) {
    let start = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o"), OsStr::new("-")];
    let output = on_small_grid(start.into_iter().chain(options.iter().map(OsStr::new)));
    let told = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(output.status.success(), "{told}");
    (image::load_from_memory(&output.stdout).expect("a picture").to_rgba8(), told)
}

fn count(picture: &RgbaImage, is_counted: impl Fn(&Rgba<u8>) -> bool) -> usize {
    picture.pixels().filter(|pixel| is_counted(pixel)).count()
}

fn is_red(pixel: &Rgba<u8>) -> bool {
    pixel.0[0] > 200 && pixel.0[1] < 60
}

fn is_green(pixel: &Rgba<u8>) -> bool {
    pixel.0[1] > 200 && pixel.0[0] < 60
}

fn is_more(a: u8, b: u8) -> bool {
    a > b.saturating_add(40)
}

/// Red at the left and green at the right, with two cameras: one sees four units parallel, the other lies on its side.
fn seen_by_two_cameras(folder: &Path) -> std::path::PathBuf {
    let mut document = banners(RED, GREEN);
    document["cameras"] = json!([
        { "type": "orthographic", "orthographic": { "xmag": 2.0, "ymag": 1.0, "znear": 0.1, "zfar": 10.0 } },
        { "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 } },
    ]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let nodes = document["nodes"].as_array_mut().expect("nodes");
    nodes.push(json!({ "name": "Flat", "camera": 0, "translation": [0.0, 0.5, 3.0] }));
    nodes.push(
        json!({ "name": "Rolled", "camera": 1, "translation": [0.0, 0.5, 3.0], "rotation": [0.0, 0.0, half, half] }),
    );
    document["scenes"][0]["nodes"] = json!([0, 1, 2, 3]);
    write(&folder.join("cameras.gltf"), &document)
}

#[test]
fn an_orthographic_camera_of_the_file_sees_parallel() {
    let folder = TempDir::new().expect("a folder");
    let scene = seen_by_two_cameras(folder.path());
    for camera in ["Flat", "0"] {
        let (picture, _) = render(&scene, &["--view", "albedo", "--camera", camera, "--size", "80x40"]);
        // A unit is 20 pixels, whatever its distance.
        assert_eq!((count(&picture, is_red), count(&picture, is_green)), (400, 400), "{camera}");
        assert!(is_red(picture.get_pixel(39, 20)) && is_green(picture.get_pixel(40, 20)), "{camera}");
    }
}

#[test]
fn a_camera_keeps_its_roll() {
    let folder = TempDir::new().expect("a folder");
    let scene = seen_by_two_cameras(folder.path());
    let (picture, _) = render(&scene, &["--view", "albedo", "--camera", "Rolled", "--size", "40x40"]);
    // It is turned to the left, so what it sees is turned to the right: left is up.
    assert!(is_red(picture.get_pixel(20, 15)) && is_green(picture.get_pixel(20, 25)));
}

#[test]
fn an_unknown_camera_is_named_beside_those_there_are() {
    let folder = TempDir::new().expect("a folder");
    let scene = seen_by_two_cameras(folder.path());
    let render = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o"), OsStr::new("-")];
    let output = octolume(render.into_iter().chain(["--camera", "Side"].map(OsStr::new)));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && output.stdout.is_empty());
    assert!(["Side", "Flat", "Rolled"].iter().all(|name| told.contains(name)), "{told}");
}

#[test]
fn only_the_front_of_a_single_sided_surface_is_seen() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("banners.gltf");
    let mut document = banners(RED, GREEN);
    document["materials"][1]["doubleSided"] = json!(true);
    let scene = write(&file, &document);
    for view in ["albedo", "mesh", "final"] {
        let view = ["--view", view, "--sun", "off", "--sky", "1,1,1", "--size", "40x30"];
        let from = |z: &'static str| {
            let options = [&view[..], &["--eye", z, "--target", "0,0.5,0"]].concat();
            let (picture, _) = render(&scene, &options);
            (
                count(&picture, |pixel| is_more(pixel.0[0], pixel.0[1])),
                count(&picture, |pixel| is_more(pixel.0[1], pixel.0[0])),
            )
        };
        let (front, back) = (from("0,0.5,3"), from("0,0.5,-3"));
        assert!(front.1 > 50 && back.1 > 50, "{view:?}: both sides of the green one, {front:?} {back:?}");
        assert_eq!(back.0, 0, "{view:?}");
    }
}

#[test]
fn the_background_can_be_left_transparent() {
    let folder = TempDir::new().expect("a folder");
    let scene = write(&folder.path().join("banners.gltf"), &banners(RED, GREEN));
    for view in ["albedo", "final", "mesh", "voxels"] {
        let options = ["--view", view, "--eye", "0,0.5,4", "--target", "0,0.5,0", "--size", "60x40"];
        let (opaque, _) = render(&scene, &options);
        assert_eq!(count(&opaque, |pixel| pixel.0[3] == 255), 60 * 40, "{view}");
        let (clear, _) = render(&scene, &[&options[..], &["--transparent"]].concat());
        assert_eq!((clear.get_pixel(0, 0).0[3], clear.get_pixel(30, 20).0[3]), (0, 255), "{view}");
    }
}

#[test]
fn the_exposure_is_told_and_a_sequence_has_one() {
    let folder = TempDir::new().expect("a folder");
    let scene = write(&folder.path().join("banners.gltf"), &banners([0.5; 3], [0.5; 3]));
    let front =
        ["--view", "direct", "--light-dir", "0,0,-1", "--eye", "0,0.5,3", "--target", "0,0.5,0", "--size", "40x30"];
    let stops = |options: &[&str]| {
        let (picture, told) = render(&scene, &[&front[..], options].concat());
        let line = told.lines().find(|line| line.starts_with("exposure")).map(str::to_owned);
        (picture, line)
    };
    let (dim, dim_line) = stops(&["--sun", "100"]);
    let (bright, bright_line) = stops(&["--sun", "102400"]);
    assert_eq!(dim.get_pixel(20, 15), bright.get_pixel(20, 15), "as bright by any light");
    let [dim, bright] = [dim_line, bright_line].map(|line| {
        let line = line.expect("a line");
        line.split(' ').nth(1).and_then(|stops| stops.parse::<f64>().ok()).unwrap_or_else(|| panic!("{line}"))
    });
    assert!((dim - bright - 10.0).abs() < 0.021, "1024 times the light are ten stops: {dim} and {bright}");
    assert_eq!(stops(&["--sun", "100", "--exposure", "-2"]).1, None, "it is set");
    let start = [OsStr::new("render"), scene.as_os_str(), OsStr::new("-o")];
    let frames = folder.path().join("frames.png");
    let options = front.iter().chain(&["--sun", "100", "--frames", "0:2", "--fps", "5"]).map(OsStr::new);
    let output = on_small_grid(start.into_iter().chain([frames.as_os_str()]).chain(options));
    let told = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(told.lines().filter(|line| line.starts_with("exposure")).count(), 1, "{told}");
}

#[test]
fn dark_vertex_colours_keep_their_shade() {
    let folder = TempDir::new().expect("a folder");
    let dark = [0.0015_f32, 0.003, 0.01];
    let mut document = banners([1.0; 3], [1.0; 3]);
    let bytes: Vec<u8> = dark.repeat(4).iter().flat_map(|channel| channel.to_le_bytes()).collect();
    let uri = format!("data:application/octet-stream;base64,{}", base64::encode(&bytes));
    let count = |list: &str| document[list].as_array().map_or(0, Vec::len);
    let (buffer, view, accessor) = (count("buffers"), count("bufferViews"), count("accessors"));
    let mut push = |list: &str, entry| document[list].as_array_mut().expect("a list").push(entry);
    push("buffers", json!({ "byteLength": bytes.len(), "uri": uri }));
    push("bufferViews", json!({ "buffer": buffer, "byteLength": bytes.len() }));
    push("accessors", json!({ "bufferView": view, "componentType": 5126, "type": "VEC3", "count": 4 }));
    for mesh in 0..2 {
        document["meshes"][mesh]["primitives"][0]["attributes"]["COLOR_0"] = json!(accessor);
    }
    let scene = write(&folder.path().join("dark.gltf"), &document);
    for options in [&[][..], &["--source", "exact"], &["--turn", "0,0,10", "--filter", "nearest"]] {
        let arrays = arrays(&voxels(&scene, &folder.path().join("dark.npz"), options));
        assert!(arrays.albedo.nrows() > 1000);
        for albedo in arrays.albedo.rows() {
            let off = albedo.iter().zip(dark).map(|(found, dark)| (found / dark - 1.0).abs()).fold(0.0, f32::max);
            assert!(off < 0.05, "{albedo} instead of {dark:?}");
        }
    }
    let (picture, _) =
        render(&scene, &["--view", "albedo", "--eye", "0,0.5,3", "--target", "0,0.5,0", "--size", "40x30"]);
    // sRGB stores these as 5, 10 and 25.5, the eight bits of the file's own colours off by up to 4 %.
    let [r, g, b, _] = picture.get_pixel(20, 15).0;
    assert!((4..=6).contains(&r) && (9..=11).contains(&g) && (24..=27).contains(&b), "{r} {g} {b}");
}
