//! The path tracer against closed forms: each within four of its own standard errors, and these small.

use std::f64::consts::PI;

use glam::DVec3;
use octolume::accuracy::path_tracer::{Film, Options, PixelSampling, Reflection, Term, TracedScene};
use octolume::progress::Progress;
use octolume::scene::{AlphaMode, LightKind, Material, Scene};
use octolume::settings::Settings;
use octolume::settings::lighting::{AddedLight, LightEdit, SunShines};

use crate::path_tracer_rig::{
    assert_mean, floor, glowing, looking, material, mean, of_panels, options, panel, prepared, room, traced,
    traced_with, under_sky,
};

fn furnace(albedo: f32) -> (Scene, Settings) {
    let scene = of_panels(room(1.0, 0), vec![glowing(albedo, 1.0)]);
    let mut settings = looking(DVec3::new(0.3, 0.1, -0.2), DVec3::new(-1.0, 0.4, 0.5));
    settings.shot.camera.as_mut().expect("is set").fov_y_degrees = 60.0;
    (scene, settings)
}

#[test]
fn a_furnace_brings_a_geometric_series_term_by_term() {
    for (albedo, samples, rough) in [(0.2, 256, 0.004), (0.5, 512, 0.004), (0.9, 1024, 0.01)] {
        let (scene, settings) = furnace(albedo);
        let albedo = f64::from(albedo);
        let film = traced(scene, &settings, samples);
        assert!((mean(&film, Term::Direct) - 1.0).abs() < 1e-9);
        assert_eq!(film.standard_error(Term::Direct).rms, 0.0);
        assert_mean(&film, Term::DiffuseFirst, albedo, rough);
        assert_mean(&film, Term::DiffuseAll, albedo / (1.0 - albedo), rough);
        assert_mean(&film, Term::FinalAll, 1.0 / (1.0 - albedo), rough);
        assert_eq!(mean(&film, Term::SpecularAll), 0.0);
    }
}

/// The floor's middle, from above and aside.
fn seen_floor() -> Settings {
    looking(DVec3::new(1.0, 2.0, 0.5), DVec3::ZERO)
}

#[test]
fn a_plane_under_a_constant_sky_shows_its_albedo() {
    let scene = of_panels(vec![floor(8.0, 0)], vec![material(0.6)]);
    let film = traced(scene, &under_sky(seen_floor(), 5.0), 16);
    let expected = 5.0 * f64::from(0.6_f32);
    for term in [Term::DiffuseFirst, Term::DiffuseAll, Term::FinalAll] {
        assert!((mean(&film, term) - expected).abs() < 1e-6, "{}", mean(&film, term));
        assert!(film.standard_error(term).rms < 1e-6);
    }
    assert_eq!((mean(&film, Term::Direct), mean(&film, Term::Ao)), (0.0, 1.0));
    assert!(film.coverage().iter().all(|share| *share == 1.0));
}

/// A wall on the floor, `height` high, its foot `distance` from the floor's middle, 16 wide.
fn walled(height: f64, distance: f64, nits: f32) -> Scene {
    let middle = DVec3::new(0.0, height / 2.0, -distance);
    let wall = panel(middle, DVec3::X * 8.0, DVec3::Y * height / 2.0, 1);
    of_panels(vec![floor(8.0, 0), wall], vec![material(1.0), glowing(0.0, nits)])
}

/// Share of what the floor sees that is wall: (1 − cos φ)/2 with φ = atan(h/d) for a wall without end, here
/// the same for one that ends on both sides `half` from the foot (Howell, configuration B-4).
fn wall_factor(height: f64, distance: f64, half: f64) -> f64 {
    let slant = height.hypot(distance);
    ((half / distance).atan() - distance / slant * (half / slant).atan()) / PI
}

#[test]
fn a_wall_on_a_floor_is_seen_by_its_view_factor() {
    let endless = 0.5 * (1.0 - (2.0_f64).atan().cos());
    assert!((wall_factor(2.0, 1.0, 1e9) - endless).abs() < 1e-9);
    for (height, distance) in [(2.0, 1.0), (1.0, 2.0), (4.0, 0.5)] {
        let factor = wall_factor(height, distance, 8.0);
        let film = traced(walled(height, distance, 3.0), &seen_floor(), 1024);
        assert_mean(&film, Term::DiffuseFirst, 3.0 * factor, 0.01);
        assert_mean(&film, Term::DiffuseAll, 3.0 * factor, 0.01);
        let film = traced(walled(height, distance, 0.0), &under_sky(seen_floor(), 2.0), 1024);
        assert_mean(&film, Term::DiffuseFirst, 2.0 * (1.0 - factor), 0.005);
    }
}

#[test]
fn a_wall_occludes_as_far_as_the_distance_reaches() {
    for (distance, reach) in [(1.0, 0.9), (1.0, 1.5), (1.0, 3.0), (0.5, 2.0)] {
        let mut settings = seen_floor();
        settings.method.cone_tracing.occlusion_distance = Some(reach);
        let film = traced(walled(6.0, distance, 0.0), &settings, 1024);
        // What is near enough of the wall is half a disc around its foot.
        let radius = f64::max(reach * reach - distance * distance, 0.0).sqrt();
        let hidden = ((radius / distance).atan() - distance * radius / (reach * reach)) / PI;
        assert_mean(&film, Term::Ao, if radius > 0.0 { 1.0 - hidden } else { 1.0 }, 0.005);
    }
}

fn lit_by(light: LightEdit, position: [f64; 3], direction: [f64; 3]) -> Settings {
    let mut settings = seen_floor();
    let added = AddedLight::new("lamp".to_owned(), light.kind);
    settings.method.lighting.added.push(AddedLight { light, position, direction, ..added });
    settings
}

fn light(kind: LightKind, intensity: f64) -> LightEdit {
    LightEdit { on: true, kind, color: [1.0; 3], intensity }
}

/// What the floor's middle sends to the eye; exact, since every light is asked.
fn assert_direct(settings: &Settings, expected: f64) {
    let film = traced(of_panels(vec![floor(8.0, 0)], vec![material(0.5)]), settings, 1);
    let found = mean(&film, Term::Direct);
    // The picture shows a hundredth of a unit of floor.
    assert!((found - expected).abs() <= 1e-3 * expected, "{found} is not {expected}");
    assert_eq!(found, mean(&film, Term::FinalAll));
}

#[test]
fn sun_point_and_spot_follow_their_laws_on_lambert() {
    let mut sun = seen_floor();
    (sun.method.lighting.sun.shines, sun.method.lighting.sun.color) = (SunShines::Always, [1.0; 3]);
    (sun.method.lighting.sun.illuminance_lux, sun.method.lighting.sun.direction) = (100.0, [0.6, -0.8, 0.0]);
    assert_direct(&sun, 0.5 * 100.0 * 0.8 / PI);
    let place = [3.0, 4.0, 0.0];
    let point = |range: Option<f32>| lit_by(light(LightKind::Point { range }, 50.0), place, [0.0, -1.0, 0.0]);
    let lambert = 0.5 * 50.0 / 25.0 * 0.8 / PI;
    assert_direct(&point(None), lambert);
    assert_direct(&point(Some(10.0)), lambert * (1.0 - 0.5_f64.powi(4)));
    assert_direct(&point(Some(4.9)), 0.0);
}

#[test]
fn a_spot_fades_between_its_cones() {
    let [inner, outer] = [0.3_f32, 0.6];
    let kind = LightKind::Spot { range: None, inner_cone_radians: inner, outer_cone_radians: outer };
    // Above the floor's middle, turned aside.
    for (turned, share) in [(0.0, 1.0), (0.29, 1.0), (0.45, f64::NAN), (0.63, 0.0)] {
        let direction = [f64::sin(turned), -f64::cos(turned), 0.0];
        let [inner, outer] = [inner, outer].map(|angle| f64::from(angle).cos());
        let fading = ((turned.cos() - outer) / (inner - outer)).powi(2);
        let share = if share.is_nan() { fading } else { share };
        let settings = lit_by(light(kind, 8.0), [0.0, 2.0, 0.0], direction);
        let film = traced(of_panels(vec![floor(8.0, 0)], vec![material(1.0)]), &settings, 1);
        let (found, expected) = (mean(&film, Term::Direct), share * 8.0 / 4.0 / PI);
        // A degree of picture is a hundredth of the fading.
        assert!((found - expected).abs() <= 0.01 * expected, "turned {turned}: {found} is not {expected}");
    }
}

#[test]
fn what_lies_between_hides_lights() {
    let roof = panel(DVec3::Y * 3.0, DVec3::X, DVec3::NEG_Z, 0);
    let scene = of_panels(vec![floor(8.0, 0), roof], vec![material(0.5)]);
    for (height, is_lit) in [(2.9, true), (4.0, false)] {
        let settings = lit_by(light(LightKind::POINT, 1.0), [0.0, height, 0.0], [0.0, -1.0, 0.0]);
        assert_eq!(mean(&traced(scene.clone(), &settings, 1), Term::Direct) > 0.0, is_lit, "{height}");
    }
}

/// Pixels see the floor through a pane that is half there, exactly through the edge between its two triangles.
#[test]
fn a_blended_pane_is_there_once_on_the_edge_its_triangles_share() {
    let pane = Material { alpha_mode: AlphaMode::Blend, base_color: [0.0, 0.0, 0.0, 0.5], ..material(0.0) };
    let over = panel(DVec3::Y, DVec3::X * 2.0, DVec3::NEG_Z * 2.0, 1);
    let scene = of_panels(vec![floor(8.0, 0), over], vec![material(1.0), pane]);
    let sun = lit_by(light(LightKind::Directional, PI), [0.0; 3], [0.0, -1.0, 0.0]);
    for aside in [0.0, 0.3] {
        let place = DVec3::new(aside, 0.0, 0.0);
        let mut settings = sun.clone();
        settings.shot.camera = looking(place + DVec3::new(0.0, 3.0, 1e-7), place).shot.camera;
        let options = Options { pixel: PixelSampling::Centre, ..options(Reflection::Lambert) };
        let film = traced_with(scene.clone(), &settings, Options { size_px: [33, 33], ..options }, 400);
        // Half of the rays reach the floor, and half of those that go on to the sun.
        let shown = film.image(Term::Direct);
        for (index, pixel) in shown.iter().enumerate() {
            assert!((pixel[0] - 0.25).abs() < 0.11, "pixel {index} {aside}: {}", pixel[0]);
        }
    }
}

fn film(threads: usize, seed: u64, samples: &[u32]) -> Film {
    let (scene, settings) = furnace(0.7);
    let prepared = prepared(scene, &settings);
    let options = octolume::accuracy::path_tracer::Options { seed, ..options(Reflection::MetallicRoughness) };
    let scene = TracedScene::new(&prepared, &settings, options).expect("a pose");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let mut film = scene.new_film();
    pool.install(|| {
        samples
            .iter()
            .for_each(|&samples| scene.trace(&mut film, samples, &Progress::default()).expect("not cancelled"))
    });
    film
}

#[test]
fn a_seed_decides_every_bit_and_threads_and_pauses_none() {
    let whole = film(1, 5, &[6]);
    assert_eq!(whole.samples(), 6);
    assert_eq!(film(3, 5, &[1, 4, 6]), whole);
    assert_ne!(film(1, 6, &[6]), whole);
}

#[test]
fn a_cancelled_step_can_be_finished() {
    let (scene, settings) = furnace(0.7);
    let prepared = prepared(scene, &settings);
    let scene = TracedScene::new(&prepared, &settings, options(Reflection::Lambert)).expect("a pose");
    let (mut film, progress) = (scene.new_film(), Progress::default());
    progress.cancel();
    assert!(scene.trace(&mut film, 2, &progress).is_err());
    assert_eq!(film.samples(), 0);
    scene.trace(&mut film, 2, &Progress::default()).expect("is not cancelled");
    let mut whole = scene.new_film();
    scene.trace(&mut whole, 2, &Progress::default()).expect("is not cancelled");
    assert_eq!(film, whole);
}

#[test]
fn the_stated_error_is_no_less_than_what_seeds_differ_by() {
    let (scene, settings) = (walled(2.0, 1.0, 3.0), seen_floor());
    let prepared = prepared(scene, &settings);
    let expected = 3.0 * wall_factor(2.0, 1.0, 8.0);
    let (mut squares, mut stated) = (0.0, 0.0);
    for seed in 0..16 {
        let options = octolume::accuracy::path_tracer::Options { seed, ..options(Reflection::Lambert) };
        let scene = TracedScene::new(&prepared, &settings, options).expect("a pose");
        let mut film = scene.new_film();
        scene.trace(&mut film, 32, &Progress::default()).expect("is not cancelled");
        let image = film.image(Term::DiffuseAll);
        squares += image.iter().map(|pixel| (f64::from(pixel[0]) - expected).powi(2)).sum::<f64>() / image.len() as f64;
        stated += film.standard_error(Term::DiffuseAll).rms.powi(2);
    }
    let (found, stated) = ((squares / 16.0).sqrt(), (stated / 16.0).sqrt());
    // 1024 pixels tell a root mean square to a fiftieth. The points of a pixel are spread evenly, so that
    // they err less than independent ones.
    assert!(found < 1.1 * stated && found > 0.05 * stated, "off by {found}, stated {stated}");
}
