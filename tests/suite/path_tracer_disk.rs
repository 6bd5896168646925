//! Pictures of the path tracer on disk: found by what paths read, and taken up where they stopped.

use std::fs;

use glam::DVec3;
use octolume::accuracy::path_tracer::{Film, Options, PixelSampling, Reflection, TracedScene};
use octolume::disk_cache::{ContentKey, DiskCache};
use octolume::progress::Progress;
use octolume::scene::{Material, Scene};
use octolume::settings::Settings;

use crate::path_tracer_rig::{floor, glowing, looking, material, of_panels, options, panel, prepared};

fn scene() -> Scene {
    let wall = panel(DVec3::new(0.0, 1.0, -1.0), DVec3::X, DVec3::Y, 1);
    of_panels(vec![floor(2.0, 0), wall], vec![material(0.5), glowing(0.2, 3.0)])
}

fn settings() -> Settings {
    looking(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO)
}

fn of_all() -> Options {
    options(Reflection::MetallicRoughness)
}

fn traced(samples: u32, from: Option<Film>) -> Film {
    let prepared = prepared(scene(), &settings());
    let scene = TracedScene::new(&prepared, &settings(), of_all()).expect("a pose");
    let mut film = from.unwrap_or_else(|| scene.new_film());
    scene.trace(&mut film, samples, &Progress::default()).expect("is not cancelled");
    film
}

fn key(scene: Scene, settings: &Settings, options: Options) -> ContentKey {
    let prepared = prepared(scene, settings);
    TracedScene::new(&prepared, settings, options).expect("a pose").key()
}

#[test]
fn a_kept_picture_goes_on_as_if_it_had_never_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let disk = DiskCache::at(folder.path());
    let key = key(scene(), &settings(), of_all());
    assert_eq!(disk.load_film(&key, [8, 8], 100), None);
    let first = traced(3, None);
    disk.store_film(&key, &first).expect("is written");
    assert_eq!(disk.contents().expect("is listed").entries, 1);
    let kept = disk.load_film(&key, [8, 8], 5).expect("is kept");
    assert_eq!((&kept, kept.secs()), (&first, first.secs()));
    let whole = traced(5, None);
    assert_eq!(traced(5, Some(kept)), whole);
    // What has more samples than asked for would be another picture.
    assert_eq!(disk.load_film(&key, [8, 8], 2), None);
    disk.store_film(&key, &whole).expect("is written");
    disk.store_film(&key, &first).expect("is left alone");
    assert_eq!(disk.load_film(&key, [8, 8], 5), Some(whole));
    assert_eq!(disk.clear().expect("is cleared").entries, 1);
    assert_eq!(disk.load_film(&key, [8, 8], 5), None);
}

#[test]
fn a_damaged_picture_is_traced_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let disk = DiskCache::at(folder.path());
    let key = key(scene(), &settings(), of_all());
    let film = traced(2, None);
    disk.store_film(&key, &film).expect("is written");
    let file = folder.path().join(key.to_string()).with_extension("film");
    let mut bytes = fs::read(&file).expect("is there");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&file, bytes).expect("is written");
    assert_eq!(disk.load_film(&key, [8, 8], 5), None);
    disk.store_film(&key, &film).expect("is written");
    assert_eq!(disk.load_film(&key, [8, 8], 5), Some(film));
}

type Change = fn(&mut Scene, &mut Settings, &mut Options);

/// Each by itself changes the picture.
const CHANGES: [Change; 18] = [
    |scene, _, _| scene.meshes[0].primitives[0].positions[1].y += 0.01,
    |scene, _, _| scene.meshes[0].primitives[0].normals[1].x += 0.5,
    |scene, _, _| scene.meshes[0].primitives[0].colors = vec![glam::Vec4::splat(0.5); 4],
    |scene, _, _| scene.materials[0].base_color[1] = 0.4,
    |scene, _, _| scene.materials[0].roughness = 0.3,
    |scene, _, _| scene.materials[0].metallic = 0.3,
    |scene, _, _| scene.materials[1].emissive[2] = 1.0,
    |scene, _, _| scene.materials[0].unlit = true,
    |scene, _, _| scene.materials[0].alpha_mode = octolume::scene::AlphaMode::Blend,
    |_, settings, _| settings.method.lighting.sky_nits[0] = 1.0,
    |_, settings, _| settings.method.lighting.emission = 2.0,
    |_, settings, _| settings.method.lighting.sun.shines = octolume::settings::lighting::SunShines::Always,
    |_, settings, _| settings.method.cone_tracing.occlusion_distance = Some(0.1),
    |_, settings, _| settings.shot.camera.as_mut().expect("is set").eye.x += 0.1,
    |_, settings, _| settings.shot.motion.turn_degrees[1] = 5.0,
    |_, _, options| options.seed += 1,
    |_, _, options| options.pixel = PixelSampling::Area,
    |_, _, options| options.reflection = Reflection::Lambert,
];

#[test]
fn the_key_is_of_all_that_paths_read() {
    let plain = key(scene(), &settings(), of_all());
    assert_eq!(key(scene(), &settings(), of_all()), plain);
    for (number, change) in CHANGES.into_iter().enumerate() {
        let (mut scene, mut settings, mut options) = (scene(), settings(), of_all());
        change(&mut scene, &mut settings, &mut options);
        assert_ne!(key(scene, &settings, options), plain, "change {number}");
    }
    let mut named = scene();
    named.materials[0] = Material { name: "renamed".to_owned(), ..named.materials[0].clone() };
    let mut cones = settings();
    (cones.method.cone_tracing.cones, cones.method.lighting.bounces) = (7, 3);
    assert_eq!(key(named, &cones, of_all()), plain);
}
