//! Reflection in the path tracer against integrals of glTF's BRDF that are taken here once more, and what
//! materials show at a hit.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use image::{Rgba, RgbaImage};
use octolume::accuracy::path_tracer::{Film, Reflection, Term};
use octolume::scene::{AlphaMode, Material, Scene, Texture, TextureRef, Wrap};
use octolume::settings::Settings;
use octolume::settings::lighting::SunShines;

use crate::path_tracer_rig::{assert_mean, floor, glowing, looking, material, mean, of_panels, options, panel};
use crate::path_tracer_rig::{traced, traced_with, under_sky};

/// Of a white metal with f0 = 1: what the specular lobe makes of a white sky, by the midpoint rule over
/// half vectors that are spread as D·cos.
fn white_metal_albedo(roughness: f64, n_v: f64) -> f64 {
    let a = roughness.powi(4);
    let root = |cosine: f64| (cosine * cosine * (1.0 - a) + a).sqrt();
    let view = DVec3::new((1.0 - n_v * n_v).sqrt(), 0.0, n_v);
    let steps = 512;
    let mut sum = 0.0;
    for i in 0..steps {
        let share = (f64::from(i) + 0.5) / f64::from(steps);
        let n_h = ((1.0 - share) / (1.0 + (a - 1.0) * share)).sqrt();
        for j in 0..steps {
            let turn = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(steps);
            let across = (1.0 - n_h * n_h).sqrt();
            let h = DVec3::new(across * turn.cos(), across * turn.sin(), n_h);
            let v_h = view.dot(h);
            let n_l = 2.0 * v_h * n_h - n_v;
            if n_l > 0.0 && v_h > 0.0 {
                let visibility = 0.5 / (n_l * root(n_v) + n_v * root(n_l));
                sum += visibility * n_l * 4.0 * v_h / n_h;
            }
        }
    }
    sum / f64::from(steps * steps)
}

fn glossy(base_color: f32, metallic: f32, roughness: f32) -> Material {
    Material { metallic, roughness, ..material(base_color) }
}

/// The floor's middle at a cosine.
fn seen_at(n_v: f64) -> Settings {
    looking(DVec3::new((1.0 - n_v * n_v).sqrt(), n_v, 0.0) * 3.0, DVec3::ZERO)
}

fn on_floor(material: Material, settings: &Settings, samples: u32) -> Film {
    let scene = of_panels(vec![floor(8.0, 0)], vec![material]);
    traced_with(scene, settings, options(Reflection::MetallicRoughness), samples)
}

#[test]
fn a_white_metal_in_a_white_furnace_gains_no_energy_and_loses_what_ggx_loses() {
    for roughness in [0.1, 0.3, 0.6, 1.0] {
        for n_v in [0.2, 0.5, 0.95] {
            let film = on_floor(glossy(1.0, 1.0, roughness), &under_sky(seen_at(n_v), 1.0), 256);
            let expected = white_metal_albedo(f64::from(roughness), n_v);
            assert!(expected <= 1.0, "{expected}");
            assert_mean(&film, Term::SpecularFirst, expected, 0.01);
            assert_eq!(mean(&film, Term::DiffuseAll), 0.0);
        }
    }
}

#[test]
fn facing_light_and_eye_the_brdf_has_a_closed_form() {
    // v = l = n: F = f0, D = 1/(π α²), V = 1/4.
    for (metallic, roughness) in [(0.0, 1.0), (0.0, 0.5), (1.0, 0.5), (1.0, 0.3)] {
        let mut settings = looking(DVec3::Y * 3.0, DVec3::ZERO);
        settings.method.lighting.sun.shines = SunShines::Always;
        (settings.method.lighting.sun.direction, settings.method.lighting.sun.color) = ([0.0, -1.0, 0.0], [1.0; 3]);
        let found = mean(&on_floor(glossy(0.8, metallic, roughness), &settings, 1), Term::Direct);
        let color = f64::from(0.8_f32);
        let f0 = 0.04 + f64::from(metallic) * (color - 0.04);
        let diffuse = (1.0 - f0) * color * f64::from(1.0 - metallic) / PI;
        let specular = f0 / (4.0 * PI * f64::from(roughness).powi(4));
        let expected = settings.method.lighting.sun.illuminance_lux * (diffuse + specular);
        // A degree of picture leaves the very middle of the highlight.
        assert!((found - expected).abs() < 5e-3 * expected, "{metallic} {roughness}: {found} is not {expected}");
    }
}

#[test]
fn a_mirror_shows_a_lit_wall() {
    // Seen at 45°, the wall behind the floor's middle is where the mirror looks, far beyond the lobe.
    let wall = panel(DVec3::new(-4.0, 0.0, 0.0), DVec3::NEG_Z * 8.0, DVec3::Y * 8.0, 1);
    let scene = of_panels(vec![floor(8.0, 0), wall], vec![glossy(1.0, 1.0, 0.0), glowing(0.0, 7.0)]);
    let film = traced_with(scene, &seen_at(0.5_f64.sqrt()), options(Reflection::MetallicRoughness), 64);
    assert_mean(&film, Term::SpecularFirst, 7.0 * white_metal_albedo(0.045, 0.5_f64.sqrt()), 0.001);
    assert!((mean(&film, Term::FinalAll) - 7.0).abs() < 0.01, "{}", mean(&film, Term::FinalAll));
}

#[test]
fn a_mirror_shows_light_that_a_wall_reflects_as_its_first_bounce() {
    let wall = panel(DVec3::new(-4.0, 0.0, 0.0), DVec3::NEG_Z * 8.0, DVec3::Y * 8.0, 1);
    let scene = of_panels(vec![floor(8.0, 0), wall], vec![glossy(1.0, 1.0, 0.0), glossy(0.5, 0.0, 1.0)]);
    let mut settings = seen_at(0.5_f64.sqrt());
    settings.method.lighting.sun.shines = SunShines::Always;
    (settings.method.lighting.sun.direction, settings.method.lighting.sun.color) = ([-1.0, 0.0, 0.0], [1.0; 3]);
    let film = traced_with(scene, &settings, options(Reflection::MetallicRoughness), 64);
    // The wall seen at 45° with the light along its normal: v·h = cos 22.5°, and α = 1.
    let lux = settings.method.lighting.sun.illuminance_lux;
    let fresnel = 0.04 + 0.96 * (1.0 - (PI / 8.0).cos()).powi(5);
    let visibility = 0.5 / (1.0 + 0.5_f64.sqrt());
    let expected = lux * ((1.0 - fresnel) * 0.5 + fresnel * visibility) / PI;
    assert_mean(&film, Term::SpecularFirst, expected * white_metal_albedo(0.045, 0.5_f64.sqrt()), 0.002);
}

fn with_texture(mut material: Material, colors: [[u8; 4]; 2], place: impl Fn(&mut Material, TextureRef)) -> Scene {
    let image = RgbaImage::from_fn(2, 1, |x, _| Rgba(colors[x as usize]));
    let texture =
        Texture { name: "two".to_owned(), image: Arc::new(image), wrap: [Wrap::ClampToEdge; 2], nearest: true };
    place(&mut material, TextureRef::new(0, 0));
    Scene { textures: vec![texture], ..of_panels(vec![floor(8.0, 0)], vec![material]) }
}

#[test]
fn what_blends_is_there_by_its_share_and_what_is_cut_out_is_not() {
    let alpha = |mode, alpha| {
        let base_color = [0.0, 0.0, 0.0, alpha];
        let cover = panel(DVec3::Y * 0.5, DVec3::X, DVec3::NEG_Z, 1);
        let see_through = Material { alpha_mode: mode, base_color, ..material(0.0) };
        let scene = of_panels(vec![floor(8.0, 0), cover], vec![glowing(0.0, 1.0), see_through]);
        // Beside the diagonal, which belongs to both triangles.
        traced(scene, &looking(DVec3::new(0.3, 3.0, 0.1), DVec3::new(0.3, 0.0, 0.1)), 256)
    };
    assert_mean(&alpha(AlphaMode::Blend, 0.3), Term::Direct, 0.7, 0.01);
    assert_eq!(mean(&alpha(AlphaMode::Mask { cutoff: 0.5 }, 0.3), Term::Direct), 1.0);
    assert_eq!(mean(&alpha(AlphaMode::Mask { cutoff: 0.2 }, 0.3), Term::Direct), 0.0);
    assert_eq!(mean(&alpha(AlphaMode::Opaque, 0.3), Term::Direct), 0.0);
}

#[test]
fn textures_give_color_emission_roughness_and_metal() {
    let film = |scene, x: f64, nits| {
        let eye = DVec3::new(x, 3.0, 0.0);
        traced_with(scene, &under_sky(looking(eye, DVec3::X * x), nits), options(Reflection::MetallicRoughness), 64)
    };
    let glow = Material { emissive: [2.0; 3], ..material(0.0) };
    let scene = || with_texture(glow.clone(), [[255; 4], [0, 0, 0, 255]], |m, slot| m.emissive_texture = Some(slot));
    assert!((mean(&film(scene(), -4.0, 0.0), Term::Direct) - 2.0).abs() < 1e-6);
    assert_eq!(mean(&film(scene(), 4.0, 0.0), Term::Direct), 0.0);
    // Green is roughness, blue metal: a white metal of roughness 0.6 on one side, black on the other.
    let colors = [[0, 153, 255, 255], [0, 255, 0, 255]];
    let metal = || with_texture(glossy(1.0, 1.0, 1.0), colors, |m, slot| m.metallic_roughness_texture = Some(slot));
    assert_mean(&film(metal(), -4.0, 1.0), Term::SpecularAll, white_metal_albedo(0.6, 1.0), 0.01);
    assert_eq!(mean(&film(metal(), -4.0, 1.0), Term::DiffuseAll), 0.0);
    assert!(mean(&film(metal(), 4.0, 1.0), Term::DiffuseAll) > 0.9);
}

#[test]
fn a_normal_map_leans_to_where_red_and_green_point() {
    // (1, 0, 1)/√2 and (0, 1, 1)/√2: to the right of the picture, and to its upper edge.
    let [red, green] = [[218, 128, 218, 255], [128, 218, 218, 255]];
    for (color, towards) in [(red, [-1.0, 0.0, 0.0]), (green, [0.0, 0.0, 1.0])] {
        for sign in [1.0, -1.0] {
            let scene = with_texture(material(1.0), [color; 2], |m, slot| m.normal_texture = Some(slot));
            let mut settings = looking(DVec3::Y * 3.0, DVec3::ZERO);
            settings.method.lighting.sun.shines = SunShines::Always;
            settings.method.lighting.sun.color = [1.0; 3];
            settings.method.lighting.sun.direction = [sign * towards[0], -1.0, sign * towards[2]];
            let found = mean(&traced(scene, &settings, 1), Term::Direct) / settings.method.lighting.sun.illuminance_lux;
            let expected = if sign > 0.0 { 1.0 / PI } else { 0.0 };
            assert!((found - expected).abs() < 0.01, "{color:?} from {sign}: {found} is not {expected}");
        }
    }
}

#[test]
fn unlit_shows_its_color_and_reflects_nothing() {
    let film = on_floor(Material { unlit: true, ..material(0.25) }, &under_sky(seen_at(0.8), 9.0), 4);
    assert!((mean(&film, Term::FinalAll) - 0.25).abs() < 1e-6);
}
