//! Direct light at what the camera sees, against f64 references and closed forms.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use octolume::data::surface_image::{SurfaceImage, SurfaceTexel};
use octolume::lights::PosedLight;
use octolume::scene::{LightKind, LocalTransform, Material, Node, OrbitCamera, Scene, Trs};
use octolume::settings::Filter;
use octolume::stages::light::illuminate_ref::{Light, Source};
use octolume::stages::surface::brdf_ref::{ALBEDO_FIT_ERROR, Reflector, specular_albedo};
use octolume::stages::surface::direct_ref::{self, Place};
use octolume::stages::surface::{LEAST_EYE_COSINE, direct_march_ref, emission_ref};
use octolume::stages::view::NO_DEPTH;

use proptest::prelude::RngExt;

use crate::device::gpu;
use crate::light_rig::{LightRig, full, grid, light, point, sun};
use crate::mesh_rig::{node, one_square};
use crate::random::rng;
use crate::stage_build::Shape;
use crate::stage_rig::{buffer, read, run, upload};
use crate::surface_rig::{Hiding, Shot, Surfaces, is_there};

const SIZE_PX: [u32; 2] = [96, 64];

/// Into a grid of 32 cells.
fn camera() -> OrbitCamera {
    OrbitCamera { eye: DVec3::new(16.0, 26.0, 40.0), target: DVec3::new(16.0, 4.0, 16.0), fov_y_degrees: 50.0 }
}

fn shot(scene: &Scene) -> Shot<'_> {
    Shot::new(scene, camera(), grid(5), SIZE_PX)
}

/// Lights in cells, as kernels and as references know them.
fn lights() -> Vec<(PosedLight, Light)> {
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
fn level(name: &str, centre: DVec3, half: f64) -> Node {
    let rotation = glam::DQuat::from_rotation_x(-PI / 2.0);
    let placed = Trs { translation: centre, rotation, scale: DVec3::splat(half) };
    Node { mesh: Some(0), local: LocalTransform::Trs(placed), ..node(name, DVec3::ZERO) }
}

fn floor(material: Material) -> Scene {
    let mut scene = one_square(material);
    scene.nodes = vec![level("floor", DVec3::new(16.0, 2.0, 16.0), 12.0)];
    scene
}

fn white() -> Material {
    Material { metallic: 0.0, roughness: 1.0, ..Material::default() }
}

/// Seen and lit from straight above, at the middle of the picture: h = n, F = f0, D V = 1/4π.
#[test]
fn irradiance_on_a_white_plane_that_faces_it_leaves_as_itself_over_pi() {
    let scene = floor(white());
    let above = OrbitCamera {
        eye: DVec3::new(16.0, 30.0, 16.0),
        target: DVec3::new(16.0, 2.0, 16.0 - 1e-6),
        fov_y_degrees: 1.0,
    };
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

/// How far inside the shadow of a level square a place is, cells; negative outside.
fn inside_shadow(place: DVec3, source: Source, centre: DVec3, half: f64) -> f64 {
    let to_light = match source {
        Source::Sun(direction) => -direction,
        Source::Point(position, _) | Source::Spot(position, ..) => position - place,
    };
    let at = place + to_light * ((centre.y - place.y) / to_light.y) - centre;
    half - at.x.abs().max(at.z.abs())
}

/// A square over a floor: the floor is dark where its shadow falls, and neither surface shadows itself.
#[test]
fn shadows_fall_where_rays_say_and_nothing_shadows_itself() {
    let centre = DVec3::new(15.0, 8.0, 15.0);
    let mut scene = floor(white());
    scene.nodes.push(level("over", centre, 3.0));
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    for (posed, light) in lights() {
        let open = shot.lit(&surfaces, &[posed.clone()], &Hiding::Nothing);
        let hidden = shot.lit(&surfaces, &[posed], &Hiding::Map(256));
        let (mut dark, mut bright) = (0, 0);
        for (pixel, texel) in surfaces.texels.iter().enumerate().filter(|(_, texel)| is_there(texel)) {
            let (place, _) = shot.place(pixel, texel);
            let inside = if place.y > 5.0 { -1e9 } else { inside_shadow(place, light.source, centre, 3.0) };
            // A texel of the widest map, on each side of the shadow's edge.
            if inside.abs() < 2.0 * 64.0 / 128.0 || open[pixel][1] == 0.0 {
                continue;
            }
            let expected = if inside > 0.0 { 0.0 } else { open[pixel][1] };
            assert_eq!(hidden[pixel][1], expected, "{:?} at {place}, {inside} inside", light.source);
            (dark, bright) = (dark + usize::from(inside > 0.0), bright + usize::from(inside < 0.0));
        }
        assert!(dark > 10 && bright > 500, "{:?}: {dark} dark, {bright} bright", light.source);
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
        let open = shot.lit(&surfaces, &[posed.clone()], &Hiding::Nothing);
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

/// The specular lobe sends back no more than arrives, and a white surface, over all ways to look at it, 4.5 %
/// more at most: glTF adds a diffuse part that knows nothing of how little light its lobe lets through at
/// grazing angles.
#[test]
fn a_white_furnace_gains_nothing_but_where_gltf_does() {
    let middles = |count: u32| (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count));
    let diffuse: Vec<f64> = middles(16).map(white_diffuse).collect();
    for roughness in middles(8) {
        let mut mean = 0.0;
        for (cosine, diffuse) in middles(16).zip(&diffuse) {
            let (scale, bias) = specular_albedo(roughness, cosine, 96);
            assert!(scale + bias < 1.0 + 1e-3, "{roughness} {cosine}: {}", scale + bias);
            mean += 2.0 * cosine / 16.0 * (diffuse + 0.04 * scale + bias);
        }
        assert!(mean < 1.045, "{roughness}: {mean}");
    }
}

/// Share of a uniform sky that a white dielectric's diffuse part reflects to an eye at this cosine.
fn white_diffuse(cosine: f64) -> f64 {
    let to_eye = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    hemisphere(|to_light| {
        let half_way = (to_light + to_eye).normalize();
        let fresnel = 0.04 + 0.96 * (1.0 - to_eye.dot(half_way)).powi(5);
        (1.0 - fresnel) / PI * to_light.z
    })
}

/// ∫ over all directions above the plane, by the middles of 64² patches of equal area.
fn hemisphere(of: impl Fn(DVec3) -> f64) -> f64 {
    const SIDE: u32 = 64;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let patches = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (at(i), at(j))));
    let sum: f64 = patches
        .map(|(z, turn)| {
            let level = (1.0 - z * z).sqrt();
            of(DVec3::new(level * (2.0 * PI * turn).cos(), level * (2.0 * PI * turn).sin(), z))
        })
        .sum();
    sum * 2.0 * PI / f64::from(SIDE * SIDE)
}

const FIT: &str = "
    #import shared/threads.wgsl
    #import shared/brdf.wgsl
    @group(0) @binding(0) var<uniform> view: ViewParams;
    @group(0) @binding(1) var surface_near: texture_2d<u32>;
    @group(0) @binding(2) var surface_stuff: texture_2d<u32>;
    // f0, roughness, cosine.
    @group(0) @binding(3) var<storage, read> asked: array<vec4<f32>>;
    @group(0) @binding(4) var<storage, read_write> found: array<f32>;
    override WORKGROUP_SIZE: u32 = 64u;
    @compute @workgroup_size(WORKGROUP_SIZE)
    fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
        let i = thread_index(id, groups);
        if i < threads.end {
            found[i] = specular_albedo(vec3<f32>(asked[i].x), asked[i].y, asked[i].z).x;
        }
    }
";

#[test]
fn the_fit_of_the_specular_albedo_is_as_near_as_it_says() {
    let shares = |count: u32| (0..=count).map(move |i| f64::from(i) / f64::from(count));
    let cosines = || [0.005, 0.01, 0.02, 0.03].into_iter().chain(shares(24).skip(1));
    let rows = shares(24).flat_map(|roughness| cosines().map(move |cosine| (roughness, cosine)));
    let asked: Vec<(f64, f64, f64)> = rows.flat_map(|(r, c)| [0.0, 0.04, 0.5, 1.0].map(|f0| (f0, r, c))).collect();
    let words: Vec<[f32; 4]> = asked.iter().map(|&(f0, r, c)| [f0 as f32, r as f32, c as f32, 0.0]).collect();
    let kernel = gpu().kernel_from_source("fit", FIT, &[]);
    let (asked_on_gpu, found) = (upload(gpu(), "asked", &words), buffer(gpu(), "found", words.len() as u64));
    run(gpu(), |frame| {
        frame.pass(&kernel).bind("asked", &asked_on_gpu).bind("found", &found).dispatch(words.len() as u64);
    });
    let found: Vec<f32> = read(gpu(), &found, words.len() as u64);
    let (mut sum, mut most) = (0.0, [0.0_f64; 4]);
    for (i, (&(f0, roughness, cosine), found)) in asked.iter().zip(found).enumerate() {
        let (scale, bias) = specular_albedo(roughness, cosine, 64);
        let expected = if f0 == 0.0 { 0.0 } else { f0 * scale + bias };
        let error = (f64::from(found) - expected).abs();
        most[i % 4] = most[i % 4].max(error);
        sum += error / asked.len() as f64;
    }
    assert!(sum < 0.006 && most[0] == 0.0 && most[1] < 0.06, "mean {sum}, most {most:?}");
    assert!(most[2].max(most[3]) < ALBEDO_FIT_ERROR, "most {most:?}");
}

/// A sphere, its vertices' normals its own: no pixel that faces the light by more than the facets differ is dark.
#[test]
fn a_smooth_sphere_does_not_shadow_itself() {
    let scene = sphere();
    let shot = shot(&scene);
    let surfaces = shot.drawn();
    for (posed, light) in lights() {
        let open = shot.lit(&surfaces, &[posed.clone()], &Hiding::Nothing);
        let hidden = shot.lit(&surfaces, &[posed], &Hiding::Map(256));
        let pixels = surfaces.texels.iter().enumerate().filter(|(pixel, _)| open[*pixel][1] > 0.0);
        let mut count = 0;
        for (pixel, texel) in pixels {
            assert_eq!(open[pixel][1], hidden[pixel][1], "{:?} at {:?}", light.source, shot.place(pixel, texel).0);
            count += 1;
        }
        assert!(count > 100, "{count}");
    }
}

fn sphere() -> Scene {
    const ROWS: u32 = 24;
    let mut scene = one_square(white());
    let primitive = &mut scene.meshes[0].primitives[0];
    let point = |row: u32, column: u32| {
        let (down, turn) = (PI * f64::from(row) / f64::from(ROWS), PI * f64::from(column) / f64::from(ROWS));
        DVec3::new(down.sin() * turn.sin(), down.cos(), down.sin() * turn.cos()).as_vec3()
    };
    let count = 2 * ROWS + 1;
    let points: Vec<Vec3> = (0..=ROWS).flat_map(|row| (0..count).map(move |column| point(row, column))).collect();
    primitive.normals = points.clone();
    primitive.positions = points;
    primitive.tex_coords = [vec![], vec![]];
    let quads = (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| row * count + column));
    primitive.triangles = quads.flat_map(|a| [[a, a + count, a + 1], [a + 1, a + count, a + count + 1]]).collect();
    scene.nodes[0].local = LocalTransform::Trs(Trs {
        translation: DVec3::new(16.0, 6.0, 16.0),
        scale: DVec3::splat(6.0),
        ..Trs::default()
    });
    scene
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
