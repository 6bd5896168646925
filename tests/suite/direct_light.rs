//! Direct light at what the camera sees, against f64 references and closed forms.

use std::f64::consts::PI;

use glam::DVec3;
use octolume::data::surface_image::{SurfaceImage, SurfaceTexel};
use octolume::lights::PosedLight;
use octolume::scene::{LightKind, LocalTransform, Material, Node, OrbitCamera, Scene, Trs};
use octolume::settings::Filter;
use octolume::stages::light::illuminate_ref::{Light, Source};
use octolume::stages::pixels::NO_DEPTH;
use octolume::stages::surface::brdf_ref::Reflector;
use octolume::stages::surface::direct_ref::{self, Place};
use octolume::stages::surface::{LEAST_EYE_COSINE, direct_march_ref, emission_ref};

use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::light_rig::{LightRig, full, grid, light, point, sun};
use crate::mesh_rig::{node, one_square};
use crate::random::rng;
use crate::stage_build::Shape;
use crate::surface_rig::{Hiding, Shot, Surfaces, is_there};

const SIZE_PX: [u32; 2] = [96, 64];

/// Into a grid of 32 cells.
fn camera() -> OrbitCamera {
    OrbitCamera::new(DVec3::new(16.0, 26.0, 40.0), DVec3::new(16.0, 4.0, 16.0), 50.0)
}

pub fn shot(scene: &Scene) -> Shot<'_> {
    Shot::new(scene, camera(), grid(5), SIZE_PX)
}

/// Lights in cells, as kernels and as references know them.
pub fn lights() -> Vec<(PosedLight, Light)> {
    let high = DVec3::new(12.0, 20.0, 18.0);
    let down = DVec3::new(0.2, -1.0, -0.1).normalize();
    let slanted = DVec3::new(0.4, -1.0, 0.3).normalize();
    let strength = DVec3::new(3000.0, 2000.0, 500.0);
    let (inner, outer) = (0.3_f32, 0.9_f32);
    let cosines = [f64::from(inner).cos(), f64::from(outer).cos()];
    let spot = LightKind::Spot { range: Some(40.0), inner_cone_radians: inner, outer_cone_radians: outer };
    let of = |kind, source| (light(kind, strength, high, down), Light { source, strength });
    vec![
        (
            light(LightKind::Directional, strength, DVec3::ZERO, slanted),
            Light { source: Source::Sun(slanted), strength },
        ),
        of(LightKind::Point { range: None }, Source::Point(high, None)),
        of(LightKind::Point { range: Some(25.0) }, Source::Point(high, Some(25.0))),
        of(spot, Source::Spot(high, down, cosines, Some(40.0))),
    ]
}

fn place_of(shot: &Shot<'_>, pixel: usize, texel: &SurfaceTexel) -> Place {
    let (position, to_eye) = shot.place(pixel, texel);
    let reflector = Reflector { albedo: texel.albedo.into(), roughness: texel.roughness, metallic: texel.metallic };
    Place { position, normal: texel.normal, face: texel.face, to_eye, reflector }
}

/// A surface at nearly every pixel, of any material, and any way that the eye can see it.
fn any_surfaces(shot: &Shot<'_>) -> Surfaces {
    let mut rng = rng(5);
    let mut share = || rng.random_range(0.0..1.0);
    let mut texel = |pixel: usize| {
        let ray = shot.rays().ray(shot.middle(pixel));
        let mut turned = || {
            let n = DVec3::new(share() - 0.5, share() - 0.5, share() - 0.5).normalize_or(DVec3::Y);
            if n.dot(ray.direction) > -2.0 * LEAST_EYE_COSINE { -ray.direction } else { n }
        };
        let (normal, face) = (turned(), turned());
        let distance_cells = if share() < 0.1 { NO_DEPTH } else { (10.0 + 40.0 * share()) as f32 };
        let albedo = [share(), share(), share()];
        let emission_nits = [100.0 * share() as f32, 0.0, 1e5];
        SurfaceTexel { distance_cells, normal, face, albedo, roughness: share(), metallic: share(), emission_nits }
    };
    let texels: Vec<SurfaceTexel> = (0..(SIZE_PX[0] * SIZE_PX[1]) as usize).map(&mut texel).collect();
    let image = SurfaceImage::new(gpu(), SIZE_PX).expect("fits");
    image.write(gpu(), &texels);
    // As stored, rounded.
    Surfaces { texels: image.read(gpu()).expect("readable"), image }
}

#[test]
fn every_light_on_every_material_is_what_the_equations_say() {
    let scene = Scene::default();
    let shot = shot(&scene);
    let surfaces = any_surfaces(&shot);
    let none = shot.lit(&surfaces, &[], &Hiding::Nothing);
    for (posed, light) in lights() {
        let found = shot.lit(&surfaces, &[posed], &Hiding::Nothing);
        let mut lit = 0;
        for (pixel, texel) in surfaces.texels.iter().enumerate() {
            let before = emission_ref::emission(texel);
            assert_eq!(none[pixel].map(f64::from), before, "{pixel} without light");
            let place = place_of(&shot, pixel, texel);
            let added = if is_there(texel) { direct_ref::radiance(&light, &place) } else { DVec3::ZERO };
            lit += usize::from(added != DVec3::ZERO);
            for lane in 0..3 {
                let expected = before[lane] + added[lane];
                // f32 places are off by 1e-5 cells at most, and highlights magnify that by 1/α² = 250 000 at most
                // in their angle's square.
                let error = (f64::from(found[pixel][lane]) - expected).abs();
                assert!(
                    error <= 2e-3 * expected + 1e-4,
                    "{found:?} is not {expected} at {pixel}",
                    found = found[pixel]
                );
            }
        }
        assert!(lit > 500, "{lit} lit");
    }
}

/// The unit square over the cells, facing up, of side 2 · `half`.
pub fn level(name: &str, centre: DVec3, half: f64) -> Node {
    let rotation = glam::DQuat::from_rotation_x(-PI / 2.0);
    let placed = Trs { translation: centre, rotation, scale: DVec3::splat(half) };
    Node { mesh: Some(0), local: LocalTransform::Trs(placed), ..node(name, DVec3::ZERO) }
}

pub fn floor(material: Material) -> Scene {
    let mut scene = one_square(material);
    scene.nodes = vec![level("floor", DVec3::new(16.0, 2.0, 16.0), 12.0)];
    scene
}

pub fn white() -> Material {
    Material { metallic: 0.0, roughness: 1.0, ..Material::default() }
}

/// Seen and lit from straight above, at the middle of the picture: h = n, F = f0, D V = 1/4π.
#[test]
fn irradiance_on_a_white_plane_that_faces_it_leaves_as_itself_over_pi() {
    let scene = floor(white());
    let above = OrbitCamera::new(DVec3::new(16.0, 30.0, 16.0), DVec3::new(16.0, 2.0, 16.0 - 1e-6), 1.0);
    let shot = Shot::new(&scene, above, grid(5), [3, 3]);
    let surfaces = shot.drawn();
    let expected = (0.96 + 0.04 / 4.0) / PI;
    let lamp = point(DVec3::new(16.0, 12.0, 16.0), 100_000.0);
    for (light, lux) in [(sun(DVec3::NEG_Y, 1000.0), 1000.0), (lamp, 1000.0)] {
        let found = shot.lit(&surfaces, &[light], &Hiding::Nothing)[4];
        assert!((f64::from(found[1]) - expected * lux).abs() < 1e-4 * lux, "{found:?}");
    }
}

#[test]
fn unlit_surfaces_reflect_nothing_and_lights_behind_a_surface_do_not_reach_it() {
    let unlit = floor(Material { unlit: true, base_color: [0.2, 0.4, 0.6, 1.0], ..Material::default() });
    let below = floor(white());
    for (scene, light) in [(&unlit, sun(DVec3::NEG_Y, 1e6)), (&below, sun(DVec3::Y, 1e6))] {
        let shot = shot(scene);
        let surfaces = shot.drawn();
        let found = shot.lit(&surfaces, &[light], &Hiding::Nothing);
        for (texel, found) in surfaces.texels.iter().zip(found) {
            assert_eq!(found.map(f64::from), emission_ref::emission(texel));
        }
    }
}

/// A wall of full leaves throws its shadow on a floor without leaves.
#[test]
fn marched_shadows_are_what_the_leaves_let_through() {
    let cells: Vec<_> = (0..8 * 8).map(|i| full([11 + i % 8, 8, 11 + i / 8], DVec3::Y, [255; 3])).collect();
    let rig = LightRig::new(gpu(), &cells, &Shape::new(5, 3, Filter::Nearest));
    let scene = floor(white());
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    let offset = 0.75;
    for (posed, light) in lights() {
        let open = shot.lit(&surfaces, std::slice::from_ref(&posed), &Hiding::Nothing);
        let found = shot.lit(&surfaces, &[posed], &Hiding::Leaves(&rig.octree, offset));
        let (mut dark, mut grazed) = (0, 0);
        for (pixel, texel) in surfaces.texels.iter().enumerate().filter(|(_, texel)| is_there(texel)) {
            let place = place_of(&shot, pixel, texel);
            let alpha = |cell: glam::IVec3| rig.occupancy(cell.to_array().map(|c| c as u32));
            let share = direct_march_ref::visibility(&place, light.source, offset, 32, alpha);
            let expected = f64::from(open[pixel][1]) * share;
            let error = (f64::from(found[pixel][1]) - expected).abs();
            // Rays that run along a face of a leaf may be rounded to either side of it.
            grazed += usize::from(error > 1e-3 * expected + 1e-4);
            dark += usize::from(share < 0.5);
        }
        assert!(dark > 50 && grazed <= 5, "{:?}: {dark} dark, {grazed} grazed", light.source);
    }
}

#[test]
fn a_light_on_a_surface_leaves_finite_radiance() {
    let scene = floor(white());
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    for height in [2.0, 2.0 + 1e-9, 2.01, 1.99] {
        let found = shot.lit(&surfaces, &[point(DVec3::new(16.0, height, 16.0), 1e6)], &Hiding::Map(64));
        assert!(found.iter().flatten().all(|value| value.is_finite() && *value >= 0.0));
    }
}
