//! The mesh view: triangles land where the camera's rays meet them, with the right colour.

use std::sync::Arc;
use std::time::Duration;

use glam::{DMat4, DQuat, DVec3, Vec4};
use octolume::gpu::Job;
use octolume::scene::{AlphaMode, LocalTransform, Material, Node, Scene, Texture, TextureRef, Trs, Wrap};
use octolume::settings::{ColorBy, Look};
use octolume::stages::pixels::camera::PixelRays;
use octolume::stages::pixels::{AMBIENT, NO_DEPTH};
use octolume::stages::view::palette::legend_object;

use crate::device::{gpu, open};

use crate::mesh_rig::*;

#[test]
fn a_square_lies_where_its_rays_meet_it() {
    let color = DVec3::new(0.2, 0.5, 0.9);
    let [r, g, b] = color.as_vec3().to_array();
    let seen = drawn(gpu(), one_square(Material { base_color: [r, g, b, 1.0], ..Material::default() }), &look());
    let mut inside = 0;
    for (index, point) in pixels() {
        let (place, distance) = meets(point, 0.0);
        let from_border = 1.0 - place.abs().x.max(place.abs().y);
        if from_border.abs() < 1e-4 {
            continue;
        }
        if from_border < 0.0 {
            assert_color(seen.colors[index], background(), "outside");
            assert_eq!(seen.distances[index], NO_DEPTH);
            continue;
        }
        inside += 1;
        assert_color(seen.colors[index], color, "inside");
        assert!((f64::from(seen.distances[index]) - distance).abs() < 1e-4 * distance, "{point:?}");
    }
    assert!(inside > 200, "{inside} pixels inside");
}

#[test]
fn the_headlight_is_that_of_the_voxels() {
    let seen = drawn(gpu(), one_square(Material::default()), &Look { shaded: true, ..look() });
    let grid = grid();
    let rays = PixelRays::new(&camera(), &grid, SIZE_PX);
    for (index, point) in pixels().filter(|(_, point)| meets(*point, 0.0).0.abs().max_element() < 0.99) {
        let light = AMBIENT + (1.0 - AMBIENT) * rays.ray(point).direction.z.abs();
        assert_color(seen.colors[index], DVec3::splat(light), "headlight");
    }
}

#[test]
fn normals_are_those_of_the_world_and_objects_have_their_palette_colour() {
    let center = (24 * 64 + 32) as usize;
    let normal = drawn(gpu(), one_square(Material::default()), &Look { color: ColorBy::Normal, ..look() });
    assert!((normal.colors[center] - DVec3::new(0.5, 0.5, 1.0)).abs().max_element() < 1.5 / 255.0);
    let object = drawn(gpu(), one_square(Material::default()), &Look { color: ColorBy::Object, ..look() });
    let expected = DVec3::from_array(legend_object(0).map(f64::from)) / 255.0;
    assert!((object.colors[center] - expected).abs().max_element() < 1.0 / 255.0);
}

#[test]
fn the_nearer_square_hides_the_farther_in_either_order() {
    for (first, second) in [(0.5, -0.5), (-0.5, 0.5)] {
        let at = |z| Node { mesh: Some(0), ..node("square", DVec3::new(0.0, 0.0, z)) };
        let seen = drawn(gpu(), scene(vec![square()], vec![at(first), at(second)]), &look());
        let center = (24 * 64 + 32) as usize;
        let (_, distance) = meets([32.5, 24.5], 0.5);
        assert!((f64::from(seen.distances[center]) - distance).abs() < 1e-4 * distance);
    }
}

#[test]
fn textures_factors_and_vertex_colours_multiply() {
    // Left half red, right half green, in sRGB bytes; the top row is v = 0.
    let image =
        image::RgbaImage::from_fn(8, 8, |x, _| image::Rgba(if x < 4 { [188, 0, 0, 255] } else { [0, 188, 0, 255] }));
    let texture = Texture { name: "halves".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: true };
    let material = Material {
        base_color: [0.5, 1.0, 1.0, 1.0],
        base_color_texture: Some(TextureRef::new(0, 0)),
        ..Material::default()
    };
    let mut scene = Scene { textures: vec![texture], ..one_square(material) };
    scene.meshes[0].primitives[0].colors = vec![Vec4::new(1.0, 0.5, 1.0, 1.0); 4];
    let seen = drawn(gpu(), scene, &look());
    let half = octolume::color::linear_from_gamma(188.0 / 255.0);
    for (index, point) in pixels() {
        let (place, _) = meets(point, 0.0);
        if place.abs().max_element() > 0.9 || place.x.abs() < 0.15 {
            continue;
        }
        let vertex_color = 128.0 / 255.0;
        let expected = if place.x < 0.0 { DVec3::X * 0.5 * half } else { DVec3::Y * vertex_color * half };
        assert_color(seen.colors[index], expected, "texture");
    }
}

#[test]
fn unlit_materials_are_not_shaded_and_transformed_textures_are_read_elsewhere() {
    let image =
        image::RgbaImage::from_fn(8, 8, |x, _| image::Rgba(if x < 4 { [188, 0, 0, 255] } else { [0, 188, 0, 255] }));
    let texture = Texture { name: "halves".to_owned(), image: Arc::new(image), wrap: [Wrap::Repeat; 2], nearest: true };
    let half_a_texture_on = glam::Affine2::from_translation(glam::Vec2::new(0.5, 0.0));
    let slot = TextureRef { uv_from_tex_coord: half_a_texture_on, ..TextureRef::new(0, 0) };
    let material = Material { base_color_texture: Some(slot), unlit: true, ..Material::default() };
    let scene = Scene { textures: vec![texture], ..one_square(material) };
    let seen = drawn(gpu(), scene, &Look { shaded: true, ..look() });
    let half = octolume::color::linear_from_gamma(188.0 / 255.0);
    for (index, point) in pixels() {
        let (place, _) = meets(point, 0.0);
        if place.abs().max_element() < 0.9 && place.x.abs() > 0.15 {
            let expected = if place.x < 0.0 { DVec3::Y * half } else { DVec3::X * half };
            assert_color(seen.colors[index], expected, "unlit");
        }
    }
}

#[test]
fn masks_cut_and_blends_cover_their_share_of_the_pixels() {
    let covered = |alpha: f32, alpha_mode: AlphaMode| {
        let seen = drawn(
            gpu(),
            one_square(Material { base_color: [1.0, 1.0, 1.0, alpha], alpha_mode, ..Material::default() }),
            &look(),
        );
        let inside: Vec<_> = pixels().filter(|(_, point)| meets(*point, 0.0).0.abs().max_element() < 0.95).collect();
        let there = inside.iter().filter(|(index, _)| seen.distances[*index] < NO_DEPTH).count();
        there as f64 / inside.len() as f64
    };
    assert_eq!(covered(0.4, AlphaMode::Mask { cutoff: 0.5 }), 0.0);
    assert_eq!(covered(0.6, AlphaMode::Mask { cutoff: 0.5 }), 1.0);
    assert_eq!(covered(0.1, AlphaMode::Opaque), 1.0);
    assert_eq!(covered(0.0, AlphaMode::Blend), 0.0);
    assert_eq!(covered(1.0, AlphaMode::Blend), 1.0);
    // 16 thresholds, cut off at the square's border.
    assert!((covered(0.5, AlphaMode::Blend) - 0.5).abs() < 0.05);
}

#[test]
fn skinned_vertices_follow_their_joints_not_their_node() {
    let move_z = DVec3::new(0.0, 0.0, 0.5);
    // 0.98 in all: weights count by their share.
    let seen = drawn(gpu(), skinned_square([move_z; 2], [[0.48, 0.5, 0.0, 0.0]; 4]), &look());
    let mut inside = 0;
    for (index, point) in pixels() {
        let (place, distance) = meets(point, 0.5);
        if place.truncate().abs().max_element() < 0.99 {
            inside += 1;
            assert!((f64::from(seen.distances[index]) - distance).abs() < 1e-4 * distance, "{point:?}");
        }
    }
    assert!(inside > 200, "{inside} pixels inside");
}

#[test]
fn each_joint_moves_its_vertices() {
    // The upper edge leans towards the camera: z = (1 + y) / 2 · 0.5.
    let (first, second) = ([1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]);
    let seen =
        drawn(gpu(), skinned_square([DVec3::ZERO, DVec3::new(0.0, 0.0, 0.5)], [first, first, second, second]), &look());
    let grid = grid();
    let rays = PixelRays::new(&camera(), &grid, SIZE_PX);
    let world_from_grid = grid.grid_from_world().inverse();
    let mut inside = 0;
    for (index, point) in pixels().filter(|(index, _)| seen.distances[*index] < NO_DEPTH) {
        let ray = rays.ray(point);
        let t = f64::from(seen.distances[index]) - ray.start_cells;
        let place = world_from_grid.transform_point3(ray.origin + ray.direction * t);
        assert!((place.z - 0.25 * (1.0 + place.y)).abs() < 1e-4, "{place}");
        inside += 1;
    }
    assert!(inside > 200, "{inside} pixels inside");
}

#[test]
fn skins_make_their_pipeline_only_where_there_are_any() {
    let gpu = open();
    drawn(&gpu, one_square(Material::default()), &look());
    let rigid = gpu.counters().pipelines;
    drawn(&gpu, one_square(Material::default()), &look());
    assert_eq!(gpu.counters().pipelines, rigid);
    drawn(&gpu, skinned_square([DVec3::ZERO; 2], [[1.0, 0.0, 0.0, 0.0]; 4]), &look());
    assert_eq!(gpu.counters().pipelines, rigid + 1);
}

#[test]
fn an_object_with_a_broken_matrix_leaves_the_rest_unharmed() {
    let mut broken = Node { mesh: Some(0), ..node("broken", DVec3::ZERO) };
    broken.local = LocalTransform::Matrix(DMat4::from_scale(DVec3::splat(f64::INFINITY)));
    let whole = Node { mesh: Some(0), ..node("whole", DVec3::ZERO) };
    let seen = drawn(gpu(), scene(vec![square()], vec![broken, whole]), &look());
    let alone =
        drawn(gpu(), scene(vec![square()], vec![Node { mesh: Some(0), ..node("whole", DVec3::ZERO) }]), &look());
    assert_eq!(seen.distances, alone.distances);
}

#[test]
fn slices_of_a_draw_make_the_whole_picture() {
    let turned = |i: u32| {
        let local = LocalTransform::Trs(Trs { rotation: DQuat::from_rotation_y(f64::from(i)), ..Trs::default() });
        Node { local, mesh: Some(0), ..node("square", DVec3::ZERO) }
    };
    let many = scene(vec![square(); 8], (0..40).map(turned).collect());
    let whole = drawn(gpu(), many.clone(), &look());
    let gpu = open();
    let (recorder, picture) = recorded(&gpu, &many, &look());
    let mut job = Job::new(recorder);
    while job.advance(&gpu, Duration::from_micros(60)).expect("runs") != octolume::gpu::JobState::Done {
        std::thread::sleep(Duration::from_micros(100));
    }
    assert_eq!(picture.read_distances(&gpu).expect("readable"), whole.distances);
    assert_eq!(gpu.counters().dispatches["view/mesh"], 1);
}
