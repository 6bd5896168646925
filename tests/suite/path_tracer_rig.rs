//! What tests of the path tracer share: scenes of panels, a camera that looks at one point, and what a
//! picture's mean must be.

use std::sync::Arc;

use glam::{DVec3, Vec2};
use octolume::accuracy::path_tracer::{Film, Options, Reflection, Term, TracedScene};
use octolume::color::luminance;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Material, Node, OrbitCamera, Primitive, Scene};
use octolume::settings::Settings;
use octolume::settings::lighting::SunShines;

use crate::mesh_rig::{node, scene};

pub fn material(color: f32) -> Material {
    Material { base_color: [color, color, color, 1.0], metallic: 0.0, ..Material::default() }
}

pub fn glowing(color: f32, nits: f32) -> Material {
    Material { emissive: [nits; 3], ..material(color) }
}

/// A parallelogram, two half sides around its middle; it faces along their cross product.
pub fn panel(middle: DVec3, right: DVec3, up: DVec3, material: usize) -> Primitive {
    let corner = |x: f64, y: f64| (middle + right * x + up * y).as_vec3();
    Primitive {
        material: Some(material),
        positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        normals: vec![right.cross(up).normalize().as_vec3(); 4],
        tex_coords: [vec![Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)], vec![]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Primitive::default()
    }
}

/// Level and facing up, around the origin.
pub fn floor(half: f64, material: usize) -> Primitive {
    panel(DVec3::ZERO, DVec3::X * half, DVec3::NEG_Z * half, material)
}

/// The six sides of a cube around the origin, facing inwards.
pub fn room(half: f64, material: usize) -> Vec<Primitive> {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let side = |out: DVec3| {
        let right = out.any_orthonormal_vector();
        panel(out * half, right * half, right.cross(out) * half, material)
    };
    sides.into_iter().map(side).collect()
}

pub fn of_panels(panels: Vec<Primitive>, materials: Vec<Material>) -> Scene {
    Scene { materials, ..scene(panels, vec![Node { mesh: Some(0), ..node("panels", DVec3::ZERO) }]) }
}

/// No light at all. Looks at `target`, and at so little of it that it is one point.
pub fn looking(eye: DVec3, target: DVec3) -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.lighting.sun.shines = SunShines::Never;
    settings.shot.camera = Some(OrbitCamera::new(eye, target, 1.0));
    settings
}

pub fn under_sky(mut settings: Settings, nits: f64) -> Settings {
    settings.method.lighting.sky_nits = [nits; 3];
    settings
}

pub fn options(reflection: Reflection) -> Options {
    Options { seed: 1, reflection, ..Options::new([8, 8]) }
}

pub fn prepared(scene: Scene, settings: &Settings) -> Arc<Prepared> {
    let prepared = prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default());
    Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")))
}

pub fn traced_with(scene: Scene, settings: &Settings, options: Options, samples: u32) -> Film {
    let prepared = prepared(scene, settings);
    let scene = TracedScene::new(&prepared, settings, options).unwrap_or_else(|error| panic!("{error}"));
    let mut film = scene.new_film();
    scene.trace(&mut film, samples, &Progress::default()).expect("is not cancelled");
    film
}

/// Surfaces that reflect their base colour every way alike.
pub fn traced(scene: Scene, settings: &Settings, samples: u32) -> Film {
    traced_with(scene, settings, options(Reflection::Lambert), samples)
}

/// Mean luminance of the picture.
pub fn mean(film: &Film, term: Term) -> f64 {
    let image = film.image(term);
    let sum: f64 = image.iter().map(|pixel| luminance(pixel.map(f64::from))).sum();
    sum / image.len() as f64
}

/// Within four standard errors, and these no more than `share` of what is expected. f32 pictures and half
/// a thousandth of a cell between rays and surfaces are allowed for.
pub fn assert_mean(film: &Film, term: Term, expected: f64, share: f64) {
    let (found, error) = (mean(film, term), film.standard_error(term).of_mean);
    let rounded = 2e-4 * expected.abs();
    assert!((found - expected).abs() <= 4.0 * error + rounded, "{term:?}: {found} ± {error} is not {expected}");
    assert!(error <= share * expected.abs(), "{term:?}: {found} ± {error} is too rough");
}
