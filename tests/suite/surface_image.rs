//! The surface image: places, normals and materials of what the camera sees, against closed forms.

use std::sync::Arc;

use glam::{Affine2, DVec3, Vec2, Vec4};
use octolume::color::linear_from_gamma;
use octolume::data::surface_image::SurfaceTexel;
use octolume::gpu::{Gpu, Job};
use octolume::scene::{AlphaMode, Material, Node, OrbitCamera, Scene, Texture, TextureRef, Wrap};

use crate::device::open;
use crate::mesh_rig::{self, SIZE_PX, meets, node, one_square, pixels, scene, skinned_square, square};
use crate::surface_rig::{Shot, is_there};

pub fn shot(scene: &Scene) -> Shot<'_> {
    Shot::new(scene, mesh_rig::camera(), mesh_rig::grid(), SIZE_PX)
}

pub fn drawn(scene: &Scene) -> Vec<SurfaceTexel> {
    shot(scene).drawn().texels
}

/// Of the square at z = 0, well inside it, with the place in scene units.
pub fn inside(texels: &[SurfaceTexel]) -> impl Iterator<Item = (DVec3, &SurfaceTexel)> {
    let on_square = pixels().map(|(index, point)| (meets(point, 0.0).0, index));
    on_square.filter(|(place, _)| place.truncate().abs().max_element() < 0.97).map(|(place, i)| (place, &texels[i]))
}

pub fn texture(image: image::RgbaImage) -> Texture {
    Texture { name: "image".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: true }
}

#[test]
fn a_texel_is_where_its_ray_meets_the_surface() {
    let material = Material { base_color: [0.2, 0.5, 0.9, 1.0], roughness: 0.4, metallic: 0.6, ..Material::default() };
    let texels = drawn(&one_square(material));
    let mut there = 0;
    for (index, point) in pixels() {
        let (place, distance) = meets(point, 0.0);
        let from_border = 1.0 - place.abs().x.max(place.abs().y);
        let texel = &texels[index];
        if from_border.abs() < 1e-4 {
            continue;
        }
        assert_eq!(is_there(texel), from_border > 0.0, "{place}");
        if from_border > 0.0 {
            there += 1;
            let error = f64::from(texel.distance_cells) / distance - 1.0;
            assert!(error.abs() < 1e-5, "{place}: off by {error}");
            assert!(texel.face.distance(DVec3::Z) < 1e-4 && texel.normal.distance(DVec3::Z) < 1e-4);
            assert!(texel.albedo.iter().zip([0.2, 0.5, 0.9]).all(|(found, e)| (found - e).abs() < 2e-5));
            assert!((texel.roughness - 0.4).abs() < 0.002 + 1e-6 && (texel.metallic - 0.6).abs() < 0.002 + 1e-6);
            assert_eq!(texel.emission_nits, [0.0; 3]);
        }
    }
    assert!(there > 200, "{there} pixels");
}

/// Parallel rays: distances count from the eye's plane, and what is seen faces along the line of sight.
#[test]
fn an_orthographic_texel_is_where_its_ray_meets_the_surface() {
    let camera = OrbitCamera { orthographic_height: Some(3.0), roll_degrees: 20.0, ..mesh_rig::camera() };
    let scene = one_square(Material::default());
    let shot = Shot::new(&scene, camera, mesh_rig::grid(), SIZE_PX);
    let (texels, rays) = (shot.drawn().texels, shot.rays());
    let grid = mesh_rig::grid();
    let plane = grid.grid_from_world().transform_point3(DVec3::ZERO).z;
    let mut there = 0;
    for (index, point) in pixels() {
        let ray = rays.ray(point);
        let t = (plane - ray.origin.z) / ray.direction.z;
        let place = grid.grid_from_world().inverse().transform_point3(ray.origin + ray.direction * t);
        let from_border = 1.0 - place.truncate().abs().max_element();
        if from_border.abs() < 1e-4 {
            continue;
        }
        assert_eq!(is_there(&texels[index]), from_border > 0.0, "{place}");
        if from_border > 0.0 {
            there += 1;
            let error = f64::from(texels[index].distance_cells) / (ray.start_cells + t) - 1.0;
            assert!(error.abs() < 1e-5, "{place}: off by {error}");
        }
    }
    assert!(there > 200, "{there} pixels");
}

#[test]
fn skinned_and_instanced_surfaces_are_where_they_are_moved() {
    let half = [[0.5, 0.5, 0.0, 0.0]; 4];
    let skinned = skinned_square([DVec3::ZERO, DVec3::Z], half);
    let at = |z| Node { mesh: Some(0), ..node("square", DVec3::new(0.0, 0.0, z)) };
    let instanced = scene(vec![square()], vec![at(-0.5), at(0.5)]);
    for (scene, what) in [(&skinned, "skinned"), (&instanced, "instanced")] {
        let texels = drawn(scene);
        for (index, point) in pixels() {
            let (place, distance) = meets(point, 0.5);
            if place.truncate().abs().max_element() < 0.99 {
                let texel = &texels[index];
                let error = f64::from(texel.distance_cells) / distance - 1.0;
                assert!(error.abs() < 1e-5, "{what} at {place}: off by {error}");
                assert!(texel.face.distance(DVec3::Z) < 1e-4 && texel.normal.distance(DVec3::Z) < 1e-4, "{what}");
            }
        }
    }
}

/// Albedo and emission as sRGB, roughness and metalness as plain shares; each slot with coordinates of its own.
#[test]
fn every_texture_is_read_where_and_as_its_slot_says() {
    let halves = |left: [u8; 4], right: [u8; 4]| {
        texture(image::RgbaImage::from_fn(8, 8, |x, _| image::Rgba(if x < 4 { left } else { right })))
    };
    let textures = vec![
        halves([188, 0, 0, 255], [0, 188, 0, 255]),
        halves([9, 51, 204, 255], [9, 204, 51, 255]),
        halves([100, 0, 0, 255], [0, 0, 200, 255]),
    ];
    let half_turn = Affine2::from_translation(Vec2::new(0.5, 0.0));
    let material = Material {
        base_color: [0.5, 0.5, 0.5, 1.0],
        base_color_texture: Some(TextureRef::new(0, 0)),
        metallic: 0.5,
        roughness: 1.0,
        metallic_roughness_texture: Some(TextureRef::new(1, 1)),
        emissive: [2.0, 1.0, 3.0],
        emissive_texture: Some(TextureRef { uv_from_tex_coord: half_turn, ..TextureRef::new(2, 0) }),
        ..Material::default()
    };
    let mut scene = Scene { textures, ..one_square(material) };
    let primitive = &mut scene.meshes[0].primitives[0];
    // The second coordinates turn left into right.
    primitive.tex_coords[1] = primitive.tex_coords[0].iter().map(|uv| Vec2::new(1.0 - uv.x, uv.y)).collect();
    primitive.colors = vec![Vec4::new(1.0, 0.5, 1.0, 1.0); 4];
    let mut shot = shot(&scene);
    shot.emission = 10.0;
    let texels = shot.drawn().texels;
    let light = |byte: f64| linear_from_gamma(byte / 255.0);
    for (place, texel) in inside(&texels).filter(|(place, _)| place.x.abs() > 0.1 && place.x.abs() < 0.9) {
        let is_left = place.x < 0.0;
        let vertex = 128.0 / 255.0;
        let albedo = if is_left { [0.5 * light(188.0), 0.0, 0.0] } else { [0.0, 0.5 * vertex * light(188.0), 0.0] };
        // Read at the second coordinates: the right half on the left.
        let (rough, metal) = if is_left { (204.0, 51.0) } else { (51.0, 204.0) };
        let emission = if is_left { [0.0, 0.0, 30.0 * light(200.0)] } else { [20.0 * light(100.0), 0.0, 0.0] };
        for lane in 0..3 {
            assert!((texel.albedo[lane] - albedo[lane]).abs() < 0.5 / 255.0, "{:?} at {place}", texel.albedo);
            let found = f64::from(texel.emission_nits[lane]);
            let nits = 10.0 * f64::from(scene.materials[0].emissive[lane]);
            assert!((found - emission[lane]).abs() < 0.5 / 255.0 * nits, "{found} at {place}");
        }
        assert!((texel.roughness - rough / 255.0).abs() < 1e-6, "{} at {place}", texel.roughness);
        assert!((texel.metallic - 0.5 * metal / 255.0).abs() < 0.002, "{} at {place}", texel.metallic);
    }
}

#[test]
fn masks_cut_out_blends_thin_out_and_unlit_colours_glow() {
    let with = |alpha_mode, alpha| {
        let material = Material { alpha_mode, base_color: [1.0, 1.0, 1.0, alpha], ..Material::default() };
        let texels = drawn(&one_square(material));
        let there: Vec<f64> = inside(&texels).map(|(_, texel)| f64::from(u8::from(is_there(texel)))).collect();
        there.iter().sum::<f64>() / there.len() as f64
    };
    assert_eq!(with(AlphaMode::Mask { cutoff: 0.5 }, 0.4), 0.0);
    assert_eq!(with(AlphaMode::Mask { cutoff: 0.5 }, 0.6), 1.0);
    assert_eq!(with(AlphaMode::Opaque, 0.1), 1.0);
    let share = with(AlphaMode::Blend, 0.25);
    assert!((share - 0.25).abs() < 0.05, "{share}");
    let unlit = Material { unlit: true, base_color: [0.2, 0.4, 0.6, 1.0], emissive: [7.0; 3], ..Material::default() };
    let scene = one_square(unlit);
    let texels = Shot { emission: 5.0, ..shot(&scene) }.drawn().texels;
    for (_, texel) in inside(&texels) {
        assert_eq!((texel.albedo, texel.metallic), ([0.0; 3], 1.0));
        let glows = texel.emission_nits.iter().zip([0.2, 0.4, 0.6]).all(|(found, e)| (found - e).abs() < 1e-6);
        assert!(glows, "{:?}", texel.emission_nits);
    }
}

#[test]
fn slices_of_a_draw_make_the_whole_image() {
    let gpu: Gpu = open();
    let many = |count: usize| {
        let at = |i: usize| Node { mesh: Some(0), ..node("square", DVec3::new(0.0, 0.0, i as f64 * 1e-3)) };
        scene(vec![square()], (0..count).map(at).collect())
    };
    let scene = many(200);
    let (frame, image) = shot(&scene).recorded(&gpu);
    let mut job = Job::new(frame);
    let mut polls = 0;
    while job.advance(&gpu, std::time::Duration::from_micros(1)).expect("runs") != octolume::gpu::JobState::Done {
        polls += 1;
        std::thread::sleep(std::time::Duration::from_micros(100));
    }
    assert!(polls > 0);
    assert_eq!(image.read(&gpu).expect("readable"), drawn(&scene));
}
