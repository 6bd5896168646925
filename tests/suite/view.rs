//! Pictures of the octree: against closed forms, and pixel by pixel against the f64 reference.

use std::collections::BTreeSet;

use glam::DVec3;
use octolume::color::gamma_from_linear;
use octolume::data::grid::morton_cell;
use octolume::data::octree::{FULL_WEIGHT, OctreeSizes};
use octolume::data::packing::pack_normal;
use octolume::gpu::Recorder;
use octolume::scene::OrbitCamera;
use octolume::settings::{AlphaRule, ColorBy, Look};
use octolume::stages::pixels::camera::{PixelRay, PixelRays};
use octolume::stages::pixels::crossings::crossings;
use octolume::stages::pixels::{BACKGROUND, LEAST_LIGHT, NO_DEPTH, Picture, ViewParams};
use octolume::stages::view::ghost::{self, LeafSet};
use octolume::stages::view::march::MarchedOctree;
use octolume::stages::view::march_ref;
use octolume::stages::view::{GHOST_COLORS, ghost_ref};

use crate::device::{gpu, open};
use crate::plain_octree::{Leaf, PlainOctree};
use crate::view_rig::*;

#[test]
fn leaves_match_the_reference_in_every_colour_and_rule() {
    let plain = random_octree(4, 2, 12, 1);
    let camera = camera(&grid(4), DVec3::new(1.0, 0.6, 1.4), 1.5);
    for color in [ColorBy::Albedo, ColorBy::Normal, ColorBy::Occupancy, ColorBy::Object, ColorBy::Level] {
        for alpha in [AlphaRule::Paper, AlphaRule::Length] {
            assert_octree_matches(gpu(), &plain, &Look { shaded: true, ..look(color, alpha) }, &camera);
        }
    }
}

#[test]
fn every_level_matches_the_reference() {
    for (dense_level, seed) in [(0, 2), (3, 3)] {
        let plain = random_octree(4, dense_level, 3, seed);
        let camera = camera(&grid(4), DVec3::new(-1.0, 0.3, 0.4), 1.2);
        for level in 0..=4 {
            let look = Look { level: Some(level), ..look(ColorBy::Albedo, AlphaRule::Length) };
            assert_octree_matches(gpu(), &plain, &look, &camera);
        }
    }
}

#[test]
fn edges_and_shading_match_the_reference() {
    let plain = random_octree(3, 1, 30, 4);
    for direction in [DVec3::new(0.3, -1.0, 0.2), DVec3::new(-0.2, 0.4, -1.0)] {
        let look = Look { voxel_edges: true, shaded: true, ..look(ColorBy::Albedo, AlphaRule::Paper) };
        assert_octree_matches(gpu(), &plain, &look, &camera(&grid(3), direction, 1.1));
    }
}

#[test]
fn an_eye_inside_the_grid_matches_the_reference() {
    let plain = random_octree(4, 2, 4, 5);
    let grid = grid(4);
    let inside = OrbitCamera::new(
        grid.corner() + DVec3::new(7.3, 8.6, 6.1) * grid.span,
        grid.corner() + DVec3::new(14.0, 3.0, 2.0) * grid.span,
        90.0,
    );
    assert_octree_matches(gpu(), &plain, &look(ColorBy::Albedo, AlphaRule::Length), &inside);
}

#[test]
fn an_eye_a_million_cells_away_still_sees_the_cells() {
    let plain = random_octree(4, 2, 20, 6);
    let mut camera = camera(&grid(4), DVec3::new(0.5, 0.4, 1.0), 65_536.0);
    // As wide as the grid at that distance, and as far as the camera narrows.
    camera.fov_y_degrees = (1.5 / 65_536.0_f64).to_degrees().max(1.0);
    assert_octree_matches(gpu(), &plain, &look(ColorBy::Albedo, AlphaRule::Paper), &camera);
}

#[test]
fn a_homogeneous_medium_stops_what_the_closed_form_says() {
    let (depth, a) = (3, 0.17);
    let plain = uniform_octree(depth, a);
    let camera = camera(&grid(depth), DVec3::new(0.9, 0.5, 0.7), 1.4);
    let rays = PixelRays::new(&camera, &grid(depth), SIZE_PX);
    for level in 0..=depth {
        let look = Look { level: Some(level), ..look(ColorBy::Albedo, AlphaRule::Length) };
        let view = ViewParams { background: [0.0; 3], ..ViewParams::new(&rays, &look, depth) };
        let seen = marched(gpu(), &plain.upload(gpu()), &view, ColorBy::Albedo);
        for (index, point) in pixels() {
            let ray = rays.ray(point);
            let length = length_inside(&ray, 8.0);
            // White medium, black behind: what is stopped is what is seen. δ is one cell.
            let expected = gamma_from_linear(1.0 - (1.0 - a).powf(length));
            // Where a ray grazes the grid, a blurred length makes a steep step in gamma encoding.
            let blur = gamma_from_linear(1.0 - (1.0 - a).powf(length + 1e-4)) - expected;
            let tolerance = 0.5 / 255.0 + 12.92 * LEAST_LIGHT + blur + 1e-4;
            let color = seen.colors[index].x;
            assert!((color - expected).abs() < tolerance, "level {level} {point:?}: {color}, not {expected}");
        }
    }
}

#[test]
fn a_single_voxel_counts_once_under_the_papers_rule_and_by_length_under_the_other() {
    let leaf = Leaf { occupancy: FULL_WEIGHT / 4, color: [255; 3], normal: pack_normal(DVec3::Y), object: 0 };
    let plain = PlainOctree::new(3, 1, [([5, 2, 6], leaf)]);
    let camera = camera(&grid(3), DVec3::new(0.2, 0.3, 1.0), 1.0);
    let rays = PixelRays::new(&camera, &grid(3), SIZE_PX);
    for alpha in [AlphaRule::Paper, AlphaRule::Length] {
        let view = ViewParams { background: [0.0; 3], ..ViewParams::new(&rays, &look(ColorBy::Albedo, alpha), 3) };
        let seen = marched(gpu(), &plain.upload(gpu()), &view, ColorBy::Albedo);
        let mut hits = 0;
        for (index, point) in pixels() {
            let ray = rays.ray(point);
            let moved = PixelRay { origin: ray.origin - DVec3::new(5.0, 2.0, 6.0), ..ray };
            let length = length_inside(&moved, 1.0);
            if length > 0.0 && length < 1e-3 {
                continue;
            }
            hits += usize::from(length > 0.0);
            let stopped = match alpha {
                AlphaRule::Paper if length > 0.0 => 0.25,
                AlphaRule::Paper => 0.0,
                AlphaRule::Length => 1.0 - 0.75_f64.powf(length),
            };
            let expected = gamma_from_linear(stopped);
            assert!((seen.colors[index].x - expected).abs() < 0.5 / 255.0 + 1e-4, "{alpha:?} {point:?}");
        }
        assert!(hits > 10, "{hits} pixels show the voxel");
    }
}

#[test]
fn an_empty_octree_shows_the_background() {
    let plain = PlainOctree::new(3, 1, []);
    let rays = PixelRays::new(&camera(&grid(3), DVec3::ONE, 1.0), &grid(3), SIZE_PX);
    let view = ViewParams::new(&rays, &look(ColorBy::Albedo, AlphaRule::Paper), 3);
    let seen = marched(gpu(), &plain.upload(gpu()), &view, ColorBy::Albedo);
    let background = DVec3::from_array(BACKGROUND.map(|c| gamma_from_linear(c.into())));
    assert!(seen.colors.iter().all(|color| (*color - background).abs().max_element() <= 0.5 / 255.0 + 1e-6));
    assert!(seen.distances.iter().all(|&distance| distance == NO_DEPTH));
}

#[test]
fn every_workgroup_size_makes_the_same_picture() {
    let plain = random_octree(4, 2, 15, 7);
    let rays = PixelRays::new(&camera(&grid(4), DVec3::new(1.0, 0.2, 0.1), 1.3), &grid(4), SIZE_PX);
    let view = ViewParams::new(&rays, &look(ColorBy::Albedo, AlphaRule::Length), 4);
    let pictures = [32, 64, 128].map(|size| {
        let gpu = open().with_workgroup_size(size);
        marched(&gpu, &plain.upload(&gpu), &view, ColorBy::Albedo).colors
    });
    assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn ghost_matches_the_reference() {
    let (depth, gpu) = (4, gpu());
    let (moved, exact) = (random_octree(depth, 2, 5, 8), random_octree(depth, 2, 6, 9));
    let cells = |plain: &PlainOctree| -> BTreeSet<[i32; 3]> {
        let cell = |key: &u32| morton_cell(*key).map(|c| c as i32);
        plain.leaves.keys().map(cell).collect()
    };
    let (moved_cells, mut exact_cells) = (cells(&moved), cells(&exact));
    // Half of the moved cells are in both.
    let shared = moved.leaves.iter().step_by(2).map(|(key, leaf)| (*key, *leaf));
    let exact = PlainOctree { leaves: exact.leaves.clone().into_iter().chain(shared).collect(), ..exact };
    exact_cells.extend(cells(&exact));
    let rays = PixelRays::new(&camera(&grid(depth), DVec3::new(0.4, 0.8, -1.0), 1.3), &grid(depth), SIZE_PX);
    let look = Look { shaded: true, ..look(ColorBy::Albedo, AlphaRule::Paper) };
    let view = ViewParams::new(&rays, &look, depth);
    let set = |plain: &PlainOctree| {
        let MarchedOctree { ranked, occupied, .. } = plain.upload(gpu);
        LeafSet { leaf_bits: ranked.leaf_bits, occupied }
    };
    let picture = Picture::new(gpu, SIZE_PX).expect("fits");
    let mut recorder = Recorder::default();
    let sets = (&set(&moved), &set(&exact));
    let sizes = OctreeSizes::upload(gpu, &moved.params).expect("small");
    ghost::record(gpu, &mut recorder, &sizes, sets, (&view, &GHOST_COLORS), &picture);
    let rules = rules(&look, depth, depth);
    assert_matches(&seen(gpu, recorder, &picture), &rays, 1 << depth, |ray| {
        march_ref::pixel(ray, 1 << depth, &rules, |cell| {
            ghost_ref::shown(cell, &moved_cells, &exact_cells, &GHOST_COLORS)
        })
    });
}

#[test]
fn distances_of_rays_count_from_the_eye() {
    let grid = grid(5);
    let camera = camera(&grid, DVec3::new(1.0, 2.0, 3.0), 4.0);
    let rays = PixelRays::new(&camera, &grid, SIZE_PX);
    let eye = grid.grid_from_world().transform_point3(camera.eye);
    for (_, point) in pixels() {
        let ray = rays.ray(point);
        assert!((eye + ray.direction * ray.start_cells).distance(ray.origin) < 1e-9);
        assert!(crossings(ray.origin, ray.direction, 32).first().is_none_or(|first| first.from >= 0.0));
    }
    let middle = rays.ray([f64::from(SIZE_PX[0]) / 2.0, f64::from(SIZE_PX[1]) / 2.0]);
    assert!(middle.direction.distance((camera.target - camera.eye).normalize()) < 1e-12);
}

#[test]
fn a_picture_without_pixels_is_refused() {
    let error = Picture::new(gpu(), [0, 10]).expect_err("no pixels").to_string();
    assert!(error.contains("0 x 10 pixels"), "{error}");
}
