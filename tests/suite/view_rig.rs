//! What tests of pictures share: grids, cameras, random octrees, and the comparison of a picture
//! with the f64 reference, pixel by pixel.

use std::collections::HashMap;

use glam::{DVec3, IVec3};
use octolume::color::linear_from_gamma;
use octolume::data::grid::{Grid, morton_cell};
use octolume::data::octree::FULL_WEIGHT;
use octolume::data::packing::pack_normal;
use octolume::gpu::{Gpu, Job, Recorder};
use octolume::scene::OrbitCamera;
use octolume::settings::{AlphaRule, ColorBy, Look};
use octolume::stages::pixels::camera::{PixelRay, PixelRays};
use octolume::stages::pixels::{BACKGROUND, LEAST_LIGHT, NO_DEPTH, Picture, ViewParams, shown_color, shown_level};
use octolume::stages::view::Palette;
use octolume::stages::view::march::{self, MarchedOctree};
use octolume::stages::view::march_ref::{self, DrawnCell, Rules};
use octolume::stages::view::palette::{legend_object, legend_value};

use crate::plain_octree::{Leaf, PlainOctree};

pub const SIZE_PX: [u32; 2] = [61, 47];
/// Inputs of a ray are f32 numbers up to twice the grid's size; a few of their last places.
pub const RAY_BLUR: f64 = 16.0 * f32::EPSILON as f64;

/// A grid in world units that are no cells, to see that rays are converted.
pub fn grid(depth: u32) -> Grid {
    Grid { anchor: DVec3::new(10.0, -4.0, 3.0), offset_cells: IVec3::new(-5, 2, 1), span: 0.25, depth }
}

/// Looks at the middle of the grid from `direction`, `distance` grid sizes away.
pub fn camera(grid: &Grid, direction: DVec3, distance: f64) -> OrbitCamera {
    let size = grid.span * f64::from(grid.cells());
    let target = grid.corner() + DVec3::splat(size / 2.0);
    OrbitCamera::new(target + direction.normalize() * distance * size, target, 40.0)
}

pub fn look(color: ColorBy, alpha: AlphaRule) -> Look {
    Look { color, alpha, shaded: false, ..Look::default() }
}

/// A repeatable stream of numbers below `n`.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn below(&mut self, n: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(n)) as u32
    }
}

/// About `share_percent` of all leaves, with random payload; every tenth normal cancelled.
pub fn random_octree(depth: u32, dense_level: u32, share_percent: u32, seed: u64) -> PlainOctree {
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
        let color = [0, 1, 2].map(|_| numbers.below(256) as u8);
        leaves.push((cell, Leaf { occupancy, color, normal: pack_normal(normal), object: numbers.below(300) as u16 }));
    }
    PlainOctree::new(depth, dense_level, leaves)
}

pub fn uniform_octree(depth: u32, occupancy: f64) -> PlainOctree {
    let cells = 1_u32 << depth;
    let occupancy = (occupancy * f64::from(FULL_WEIGHT)).round() as u32;
    let leaf = Leaf { occupancy, color: [255; 3], normal: pack_normal(DVec3::X), object: 0 };
    let all = (0..cells.pow(3)).map(|i| ([i % cells, i / cells % cells, i / cells.pow(2)], leaf));
    PlainOctree::new(depth, depth.saturating_sub(2), all)
}

/// Colours 0 … 1 as stored, and distances.
pub struct Seen {
    pub colors: Vec<DVec3>,
    pub distances: Vec<f32>,
}

pub fn seen(gpu: &Gpu, recorder: Recorder, picture: &Picture) -> Seen {
    Job::new(recorder).run_to_end(gpu).expect("runs");
    let bytes = picture.read(gpu).expect("readable").into_raw();
    let color = |p: &[u8]| DVec3::new(p[0].into(), p[1].into(), p[2].into()) / 255.0;
    Seen { colors: bytes.chunks(4).map(color).collect(), distances: picture.read_distances(gpu).expect("readable") }
}

pub fn marched(gpu: &Gpu, octree: &MarchedOctree, view: &ViewParams, color: ColorBy) -> Seen {
    let picture = Picture::new(gpu, SIZE_PX).expect("fits");
    let mut recorder = Recorder::default();
    march::record(gpu, &mut recorder, octree, (view, &Palette::new(color)), &picture);
    seen(gpu, recorder, &picture)
}

pub fn pixels() -> impl Iterator<Item = (usize, [f64; 2])> {
    let [width, height] = SIZE_PX;
    (0..width * height).map(move |i| (i as usize, [f64::from(i % width) + 0.5, f64::from(i / width) + 0.5]))
}

/// The ray itself and its neighbours as far as f32 can blur it.
pub fn blurred(ray: &PixelRay, cells: f64) -> Vec<PixelRay> {
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

/// By how much rays that f32 cannot tell apart may disagree and still say something: a quarter of an 8-bit step.
const RAYS_AGREE: f64 = 1e-3;

/// Every pixel is what the reference says: within half an 8-bit step, the light that is left out where the display
/// curve is steepest (12.92), as much as neighbouring rays disagree, and 1e-4 for pow (WGSL: 2^-11 of its exponent's
/// error; drivers stay below 2^-16) and sums of up to 3 · 2^8 steps of 2^-24.
/// Pixels on which rays that f32 cannot tell apart disagree say nothing; they must be few.
pub fn assert_matches(
    seen: &Seen,
    rays: &PixelRays,
    cells: u32,
    reference: impl Fn(&PixelRay) -> (DVec3, Option<f64>),
) {
    let tolerance = 0.5 / 255.0 + 12.92 * LEAST_LIGHT + RAYS_AGREE + 1e-4;
    let mut blurry = 0;
    for (index, point) in pixels() {
        let allowed: Vec<_> = blurred(&rays.ray(point), f64::from(cells)).iter().map(&reference).collect();
        let (expected, depth) = allowed[0];
        let agrees = |(color, other): &(DVec3, Option<f64>)| {
            (*color - expected).abs().max_element() < RAYS_AGREE && is_near(*other, depth)
        };
        if !allowed.iter().all(agrees) {
            blurry += 1;
            continue;
        }
        let color = seen.colors[index];
        let off = (color - expected).abs().max_element();
        assert!(off < tolerance, "pixel {point:?}: {color} is not {expected}");
        let distance = Some(f64::from(seen.distances[index])).filter(|&distance| distance < f64::from(NO_DEPTH));
        assert!(is_near(distance, depth), "pixel {point:?}: distance {distance:?} is not {depth:?}");
    }
    assert!(blurry * 20 < seen.colors.len(), "{blurry} of {} pixels say nothing", seen.colors.len());
}

/// Distances of up to some hundred cells, in a few roundings of 2^-24 and the blur of a ray, which slanting faces stretch;
/// where they stretch it more, neighbouring rays differ by more than this, too.
pub fn is_near(distance: Option<f64>, other: Option<f64>) -> bool {
    match (distance, other) {
        (Some(a), Some(b)) => (a - b).abs() < 1e-4 * b.max(1.0),
        (a, b) => a == b,
    }
}

/// Every cell that a look shows.
pub fn shown_cells(plain: &PlainOctree, look: &Look) -> HashMap<IVec3, DrawnCell> {
    let level = shown_level(look, plain.params.depth);
    let cell = |key: u32| IVec3::from_array(morton_cell(key).map(|c| c as i32));
    plain.occupied(level).into_iter().filter_map(|key| Some((cell(key), shown(plain, look, level, key)?))).collect()
}

pub fn shown(plain: &PlainOctree, look: &Look, level: u32, key: u32) -> Option<DrawnCell> {
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
        ColorBy::Radiance | ColorBy::Irradiance => unreachable!("light has a kernel of its own"),
    };
    let shaded = look.shaded && !matches!(color, ColorBy::Normal | ColorBy::Occupancy);
    Some(DrawnCell { occupancy: mean.occupancy, color: painted, normal: mean.normal, shaded })
}

pub fn rules(look: &Look, depth: u32, level: u32) -> Rules {
    Rules {
        alpha: look.alpha,
        edges: look.voxel_edges,
        scale: f64::from(1u32 << (depth - level)),
        background: DVec3::from_array(BACKGROUND.map(f64::from)),
    }
}

pub fn assert_octree_matches(gpu: &Gpu, plain: &PlainOctree, look: &Look, camera: &OrbitCamera) {
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

/// By slabs, not by cells.
pub fn length_inside(ray: &PixelRay, cells: f64) -> f64 {
    let (a, b) = ((-ray.origin) / ray.direction, (DVec3::splat(cells) - ray.origin) / ray.direction);
    (a.max(b).min_element() - a.min(b).max_element().max(0.0)).max(0.0)
}
