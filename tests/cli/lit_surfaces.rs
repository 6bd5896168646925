//! Lit surfaces from a script: every part, as pictures and as linear light, on real scenes.

use std::path::{Path, PathBuf};

use image::Rgb32FImage;

use crate::real_scenes::real_scenes;
use crate::walls::{knight_in_a_room, white_plane};
use crate::{octolume, on_small_grid, succeed};

/// No pixel is brighter than the one of a thousand times this: fireflies are. A lamp that is seen is no
/// firefly, but hundreds of pixels.
const BRIGHTEST_OVER_P999: f32 = 16.0;

fn light(scene: &Path, file: &Path, options: &[&str]) -> Rgb32FImage {
    let start = ["render".as_ref(), scene.as_os_str(), "-o".as_ref(), file.as_os_str()];
    succeed(start.into_iter().chain(options.iter().map(AsRef::as_ref)));
    image::open(file).expect("a picture").into_rgb32f()
}

/// Scene and how it is lit and seen.
fn scenes(folder: &Path) -> Vec<(PathBuf, Vec<&'static str>)> {
    let mut scenes = vec![(PathBuf::from("courtyard"), vec!["--sky", "1,1,2"])];
    if let Some(shared) = real_scenes() {
        let inside = vec!["--sun", "100000", "--eye=-9,2,-0.5", "--target", "6,3,0", "--fov", "60"];
        scenes.push((shared.join("CornellBox/CornellBox.glb"), vec![]));
        scenes.push((shared.join("Sponza/Sponza.gltf"), inside));
    }
    let lamp = vec!["--add-light", "point:at=0.5,3.4,1:candela=30", "--eye", "0,2,5.5", "--target", "0,1.6,0"];
    scenes.extend(knight_in_a_room(folder).map(|room| (room, lamp)));
    scenes
}

#[test]
fn light_on_real_scenes_is_finite_and_free_of_fireflies() {
    let folder = tempfile::tempdir().expect("a folder");
    for (scene, options) in scenes(folder.path()) {
        for part in ["final", "diffuse", "specular"] {
            let options = [&["--view", part, "--size", "160x90"], &options[..]].concat();
            let picture = light(&scene, &folder.path().join("light.exr"), &options);
            assert!(
                picture.iter().all(|channel| channel.is_finite() && *channel >= 0.0),
                "{}: {part}",
                scene.display()
            );
            let mut values: Vec<f32> = picture.pixels().map(|pixel| pixel.0.into_iter().fold(0.0, f32::max)).collect();
            values.sort_by(f32::total_cmp);
            let p999 = values[values.len() * 999 / 1000];
            let brightest = values[values.len() - 1];
            assert!(
                brightest <= BRIGHTEST_OVER_P999 * p999 && p999 > 0.0,
                "{}: {part}: {brightest} over {p999}",
                scene.display()
            );
        }
    }
}

#[test]
fn a_white_plane_facing_a_light_shows_a_pi_th_of_its_lux() {
    let folder = tempfile::tempdir().expect("a folder");
    let plane = white_plane(folder.path());
    let file = folder.path().join("light.exr");
    let sun =
        ["--sun", "1000", "--light-dir", "0,-1,0", "--eye", "0,3,0", "--target", "0,0,0", "--diffuse-cones", "off"];
    let options = [&["--view", "direct", "--size", "9x9"], &sun[..]].concat();
    let picture = light(&plane, &file, &options);
    let found = picture.get_pixel(4, 4).0[1];
    // The sun is a little yellow: 0.96 of green. Light and eye lie along the normal, where the dielectric reflects
    // f0 = 0.04: of the rest all is spread, (1 − f0) / π, and at roughness 1 the lobe is f0 · D · V = f0 / π · 1/4.
    let expected = 0.96 * 1000.0 * (0.96 + 0.04 / 4.0) / std::f32::consts::PI;
    // Material and normal are exact in their formats; 64 roundings of f32.
    assert!((found / expected - 1.0).abs() < 64.0 * f32::EPSILON, "{found} is not {expected}");
}

#[test]
fn every_part_has_a_picture_and_linear_light() {
    let folder = tempfile::tempdir().expect("a folder");
    let plane = white_plane(folder.path());
    for part in ["final", "direct", "diffuse", "specular", "ao", "albedo", "normal", "depth", "roughness"] {
        let options = ["--view", part, "--size", "48x32", "--sky", "1,1,1"];
        let values = light(&plane, &folder.path().join("light.exr"), &options);
        assert!(values.iter().any(|value| *value != 0.0), "{part}");
        let picture = light(&plane, &folder.path().join("light.png"), &options);
        assert_eq!(picture.dimensions(), (48, 32));
    }
    let curves = ["linear", "reinhard", "aces"].map(|curve| {
        let file = folder.path().join("light.png");
        light(&plane, &file, &["--view", "final", "--size", "48x32", "--curve", curve])
    });
    assert!(curves[0] != curves[1] && curves[1] != curves[2]);
}

#[test]
fn octree_views_have_no_linear_light() {
    let refused = on_small_grid(["render", "courtyard", "-o", "out.exr", "--view", "voxels"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("only views of surfaces"));
    let odd = octolume(["render", "courtyard", "-o", "out.png", "--pixel-cones", "0"]);
    assert_eq!(odd.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&odd.stderr).contains("0 diffuse cones are not in 1 to 64"));
}
