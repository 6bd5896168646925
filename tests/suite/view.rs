//! Pictures of the octree: against closed forms, and pixel by pixel against the f64 reference.

use std::collections::{BTreeSet, HashMap};

use glam::{DVec3, IVec3};
use octolume::data::grid::{Grid, morton_cell};
use octolume::data::octree::FULL_WEIGHT;
use octolume::data::packing::pack_normal;
use octolume::gpu::{Gpu, Job, Recorder};
use octolume::scene::OrbitCamera;
use octolume::settings::{AlphaRule, ColorBy, Look};
use octolume::stages::view::camera::{PixelRay, PixelRays};
use octolume::stages::view::ghost::{self, LeafSet};
use octolume::stages::view::march::{self, MarchedOctree};
use octolume::stages::view::march_ref::{self, Rules, Shown, crossings};
use octolume::stages::view::palette::{gamma_from_linear, legend_object, legend_value, linear_from_gamma};
use octolume::stages::view::{
    BACKGROUND, GHOST_COLORS, LEAST_LIGHT, NO_DEPTH, Palette, Picture, ViewParams, ghost_ref, shown_color, shown_level,
};

use crate::device::{gpu, open};
use crate::plain_octree::{Leaf, PlainOctree};

const SIZE_PX: [u32; 2] = [61, 47];
/// Inputs of a ray are f32 numbers up to twice the grid's size; a few of their last places.
const RAY_BLUR: f64 = 16.0 * f32::EPSILON as f64;

/// A grid in world units that are no cells, to see that rays are converted.
fn grid(depth: u32) -> Grid {
    Grid { anchor: DVec3::new(10.0, -4.0, 3.0), offset_cells: IVec3::new(-5, 2, 1), span: 0.25, depth }
}

/// Looks at the middle of the grid from `direction`, `distance` grid sizes away.
fn camera(grid: &Grid, direction: DVec3, distance: f64) -> OrbitCamera {
    let size = grid.span * f64::from(grid.cells());
    let target = grid.corner() + DVec3::splat(size / 2.0);
    OrbitCamera { eye: target + direction.normalize() * distance * size, target, fov_y_degrees: 40.0 }
}

fn look(color: ColorBy, alpha: AlphaRule) -> Look {
    Look { color, alpha, shaded: false, ..Look::default() }
}

/// A repeatable stream of numbers below `n`.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(n)) as u32
    }
}

/// About `share_percent` of all leaves, with random payload; every tenth normal cancelled.
fn random_octree(depth: u32, dense_level: u32, share_percent: u32, seed: u64) -> PlainOctree {
    let mut numbers = Numbers(seed);
    let cells = 1 << depth;
    let mut leaves = Vec::new();
    for index in 0..cells * cells * cells {
        let cell = [index % cells, index / cells % cells, index / (cells * cells)];
        if numbers.below(100) >= share_percent {
            continue;
        }
        let mut signed = || f64::from(numbers.below(2001)) / 1000.0 - 1.0;
        let normal = DVec3::new(signed(), signed(), signed());
        let normal = if numbers.below(10) == 0 { DVec3::ZERO } else { normal };
        let occupancy = if numbers.below(4) == 0 { FULL_WEIGHT } else { 1 + numbers.below(FULL_WEIGHT) };
        let rgb8 = [0, 1, 2].map(|_| numbers.below(256) as u8);
        leaves.push((cell, Leaf { occupancy, rgb8, normal: pack_normal(normal), object: numbers.below(300) as u16 }));
    }
    PlainOctree::new(depth, dense_level, leaves)
}

fn uniform_octree(depth: u32, occupancy: f64) -> PlainOctree {
    let cells = 1_u32 << depth;
    let occupancy = (occupancy * f64::from(FULL_WEIGHT)).round() as u32;
    let leaf = Leaf { occupancy, rgb8: [255; 3], normal: pack_normal(DVec3::X), object: 0 };
    let all = (0..cells.pow(3)).map(|i| ([i % cells, i / cells % cells, i / cells.pow(2)], leaf));
    PlainOctree::new(depth, depth.saturating_sub(2), all)
}

/// Colours 0 … 1 as stored, and distances.
struct Seen {
    colors: Vec<DVec3>,
    distances: Vec<f32>,
}

fn seen(gpu: &Gpu, recorder: Recorder, picture: &Picture) -> Seen {
    Job::new(recorder).run_to_end(gpu).expect("runs");
    let bytes = picture.read(gpu).expect("readable").into_raw();
    let color = |p: &[u8]| DVec3::new(p[0].into(), p[1].into(), p[2].into()) / 255.0;
    Seen { colors: bytes.chunks(4).map(color).collect(), distances: picture.read_distances(gpu).expect("readable") }
}

fn marched(gpu: &Gpu, octree: &MarchedOctree, view: &ViewParams, color: ColorBy) -> Seen {
    let picture = Picture::new(gpu, SIZE_PX).expect("fits");
    let mut recorder = Recorder::default();
    march::record(gpu, &mut recorder, octree, (view, &Palette::new(color)), &picture);
    seen(gpu, recorder, &picture)
}

fn pixels() -> impl Iterator<Item = (usize, [f64; 2])> {
    let [width, height] = SIZE_PX;
    (0..width * height).map(move |i| (i as usize, [f64::from(i % width) + 0.5, f64::from(i / width) + 0.5]))
}

/// The ray itself and its neighbours as far as f32 can blur it.
fn blurred(ray: &PixelRay, cells: f64) -> Vec<PixelRay> {
    let aside = ray.direction.any_orthonormal_vector();
    let other = ray.direction.cross(aside);
    let shifts = [
        (0.0, 0.0),
        (1.0, 0.0),
        (-1.0, 0.0),
        (0.0, 1.0),
        (0.0, -1.0),
        (0.7, 0.7),
        (-0.7, 0.7),
        (0.7, -0.7),
        (-0.7, -0.7),
    ];
    let shifted =
        |(a, b): (f64, f64)| PixelRay { origin: ray.origin + (aside * a + other * b) * RAY_BLUR * 2.0 * cells, ..*ray };
    shifts.map(shifted).to_vec()
}

/// Every pixel is what the reference says, within half an 8-bit step and the light that is left out.
/// Pixels on which rays that f32 cannot tell apart disagree say nothing; they must be few.
fn assert_matches(seen: &Seen, rays: &PixelRays, cells: u32, reference: impl Fn(&PixelRay) -> (DVec3, Option<f64>)) {
    let tolerance = 0.5 / 255.0 + 12.92 * LEAST_LIGHT + 1e-4;
    let mut blurry = 0;
    for (index, point) in pixels() {
        let allowed: Vec<_> = blurred(&rays.ray(point), f64::from(cells)).iter().map(&reference).collect();
        let (expected, depth) = allowed[0];
        let agrees = |(color, other): &(DVec3, Option<f64>)| {
            (*color - expected).abs().max_element() < 1e-3 && is_near(*other, depth)
        };
        if !allowed.iter().all(agrees) {
            blurry += 1;
            continue;
        }
        let color = seen.colors[index];
        let off = (color - expected).abs().max_element();
        assert!(off < tolerance + 1e-3, "pixel {point:?}: {color} is not {expected}");
        let distance = Some(f64::from(seen.distances[index])).filter(|&distance| distance < f64::from(NO_DEPTH));
        assert!(is_near(distance, depth), "pixel {point:?}: distance {distance:?} is not {depth:?}");
    }
    assert!(blurry * 20 < seen.colors.len(), "{blurry} of {} pixels say nothing", seen.colors.len());
}

fn is_near(distance: Option<f64>, other: Option<f64>) -> bool {
    match (distance, other) {
        (Some(a), Some(b)) => (a - b).abs() < 1e-3 * b.max(1.0),
        (a, b) => a == b,
    }
}

/// Every cell that a look shows.
fn shown_cells(plain: &PlainOctree, look: &Look) -> HashMap<IVec3, Shown> {
    let level = shown_level(look, plain.params.depth);
    let cell = |key: u32| IVec3::from_array(morton_cell(key).map(|c| c as i32));
    plain.occupied(level).into_iter().filter_map(|key| Some((cell(key), shown(plain, look, level, key)?))).collect()
}

fn shown(plain: &PlainOctree, look: &Look, level: u32, key: u32) -> Option<Shown> {
    let depth = plain.params.depth;
    let mean = plain.mean(level, key)?;
    let linear = |bytes: [u8; 3]| DVec3::from_array(bytes.map(|byte| linear_from_gamma(f64::from(byte) / 255.0)));
    let color = shown_color(look, depth);
    let painted = match color {
        ColorBy::Albedo => mean.albedo,
        ColorBy::Normal => DVec3::from_array((mean.normal * 0.5 + 0.5).to_array().map(linear_from_gamma)),
        ColorBy::Occupancy => linear(legend_value(color, mean.occupancy)),
        ColorBy::Level => linear(legend_value(color, f64::from(level) / f64::from(depth))),
        ColorBy::Object => linear(legend_object(plain.leaves[&key].object.into())),
    };
    let shaded = look.shaded && !matches!(color, ColorBy::Normal | ColorBy::Occupancy);
    Some(Shown { occupancy: mean.occupancy, color: painted, normal: mean.normal, shaded })
}

fn rules(look: &Look, depth: u32, level: u32) -> Rules {
    Rules {
        alpha: look.alpha,
        edges: look.voxel_edges,
        scale: f64::from(1u32 << (depth - level)),
        background: DVec3::from_array(BACKGROUND.map(f64::from)),
    }
}

fn assert_octree_matches(gpu: &Gpu, plain: &PlainOctree, look: &Look, camera: &OrbitCamera) {
    let depth = plain.params.depth;
    let level = shown_level(look, depth);
    let rays = PixelRays::new(camera, &grid(depth), SIZE_PX);
    let view = ViewParams::new(&rays, look, depth);
    let seen = marched(gpu, &plain.upload(gpu), &view, shown_color(look, depth));
    let (rules, cells) = (rules(look, depth, level), shown_cells(plain, look));
    assert_matches(&seen, &rays, 1 << depth, |ray| {
        march_ref::pixel(ray, 1 << level, &rules, |cell| cells.get(&cell).copied())
    });
}

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
    let inside = OrbitCamera {
        eye: grid.corner() + DVec3::new(7.3, 8.6, 6.1) * grid.span,
        target: grid.corner() + DVec3::new(14.0, 3.0, 2.0) * grid.span,
        fov_y_degrees: 90.0,
    };
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

/// By slabs, not by cells.
fn length_inside(ray: &PixelRay, cells: f64) -> f64 {
    let (a, b) = ((-ray.origin) / ray.direction, (DVec3::splat(cells) - ray.origin) / ray.direction);
    (a.max(b).min_element() - a.min(b).max_element().max(0.0)).max(0.0)
}

#[test]
fn a_single_voxel_counts_once_under_the_papers_rule_and_by_length_under_the_other() {
    let leaf = Leaf { occupancy: FULL_WEIGHT / 4, rgb8: [255; 3], normal: pack_normal(DVec3::Y), object: 0 };
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
        let MarchedOctree { leaf_bits, occupied, .. } = plain.upload(gpu);
        LeafSet { leaf_bits, occupied }
    };
    let picture = Picture::new(gpu, SIZE_PX).expect("fits");
    let mut recorder = Recorder::default();
    let sets = (&set(&moved), &set(&exact));
    ghost::record(gpu, &mut recorder, &moved.params, sets, (&view, &GHOST_COLORS), &picture);
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
