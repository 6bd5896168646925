//! Cones from surfaces against closed forms: an open plane, a wall on a floor, a hole in a ceiling, a white
//! furnace. Tables by cone count with `--nocapture`; as JSON where `OCTOLUME_MEASURED` names a folder.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use octolume::settings::lighting::Opacity;
use octolume::settings::{ConeTracing, Filter, Lookup};
use octolume::stages::cones::diffuse::DiffuseCones;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::pixels::LEAST_LIGHT;
use octolume::stages::sample::Sampler;
use serde::{Deserialize, Serialize};

use crate::cone_light::{BOTH, scattered};
use crate::cone_rig::{SPOT_PX, diffuse, mean, spot};
use crate::device::gpu;
use crate::doc_tables::measured;
use crate::lit_octree::LitBuild;
use crate::octree_rules::Cell;
use crate::random::ONE;
use crate::stage_build::Shape;
use crate::view_rig::grid;

pub const DEPTH: u32 = 6;
pub const CELLS: i64 = 64;
/// Lowest layer of the floor, which is one voxel thick.
pub const FLOOR: i64 = 9;
/// How near the known error of a form is met: half of the last place it is written with, LEAST_LIGHT that cones
/// leave, and roundings of 256 places on a ray, 2^-24 of 64 cells each, where opacity changes by 3 a cell.
const FORM_SLACK: f64 = 0.0005 + LEAST_LIGHT + 3.0 * 256.0 * 64.0 * f32::EPSILON as f64 / 2.0;

const COMMAND: &str = "cargo test --test suite cone_forms";

/// Share of the sky that a wall hides from a floor.
#[derive(Serialize, Deserialize)]
pub struct WallRow {
    pub aperture_degrees: f64,
    pub opacity: Opacity,
    pub distance_voxels: f64,
    /// ½(1 − cos φ) of an infinite wall as high.
    pub infinite: f64,
    /// Of this wall, in closed form.
    pub closed: f64,
    /// By cones, by their number.
    pub hidden: BTreeMap<u32, f64>,
}

/// Share of the sky that a square hole in a ceiling lets in.
#[derive(Serialize, Deserialize)]
pub struct HoleRow {
    pub side_voxels: i64,
    pub closed: f64,
    /// By cones of 4° and of 30°.
    pub narrow: f64,
    pub wide: f64,
}

/// A voxel in every cell of a box, `raise` 256ths of a cell higher.
pub fn solid(low: [i64; 3], high: [i64; 3], raise: i64) -> impl Iterator<Item = Fragment> {
    let size = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    (0..size.iter().product()).map(move |i| {
        let [x, y, z] = [low[0] + i % size[0], low[1] + i / size[0] % size[1], low[2] + i / (size[0] * size[1])];
        Fragment { q: [x * ONE, y * ONE, z * ONE + raise], normal: [511, 511, 1022], albedo: [128; 3], coverage: 255 }
    })
}

pub fn floor(raise: i64) -> impl Iterator<Item = Fragment> {
    solid([0, 0, FLOOR], [CELLS, CELLS, FLOOR + 1], raise)
}

pub fn built(voxels: impl Iterator<Item = Fragment>, radiance: impl Fn(Cell) -> f64) -> LitBuild {
    let voxels: Vec<_> = voxels.collect();
    LitBuild::new(gpu(), &voxels, &Shape::new(DEPTH, 4, Filter::Split), |cell, a| (DVec3::splat(radiance(cell)), a))
}

/// Mean radiance and open share of all cones at a point under a sky of 1.
fn seen(octree: &LitBuild, opacity: Opacity, settings: &ConeTracing, (point, face): (DVec3, DVec3)) -> [f64; 2] {
    let photo = spot(gpu(), &grid(DEPTH), point, face);
    let sampler = Sampler { opacity, ..Sampler::default() };
    // Everything in the grid occludes.
    let settings = ConeTracing { occlusion_distance: Some(1e3), ..*settings };
    let cones = DiffuseCones::new(&settings, CELLS as u32, 0.25);
    let input = (&octree.sampled(Lookup::Ranks), &sampler);
    let [radiance, _, _, open] = mean(&diffuse(gpu(), input, &photo, (&cones, BOTH), ([1.0; 3], [SPOT_PX; 2])));
    [radiance, open]
}

fn tracing(cones: u32, cone_degrees: f64) -> ConeTracing {
    ConeTracing { cones, cone_degrees, ..ConeTracing::default() }
}

/// Share of the cosine-weighted hemisphere that a polygon above the surface takes (Lambert's formula).
fn form_factor(point: DVec3, face: DVec3, corners: &[DVec3]) -> f64 {
    let edge = |i: usize| {
        let (a, b) = ((corners[i] - point).normalize(), (corners[(i + 1) % corners.len()] - point).normalize());
        a.angle_between(b) * a.cross(b).normalize().dot(face)
    };
    ((0..corners.len()).map(edge).sum::<f64>() / TAU).abs()
}

#[test]
fn an_open_plane_sees_all_of_the_sky_at_every_aperture_and_offset() {
    for raise in [0, ONE / 4, ONE / 2, 3 * ONE / 4] {
        let octree = built(floor(raise), |_| 0.0);
        let height = FLOOR as f64 + 0.5 + raise as f64 / ONE as f64;
        for (cones, degrees) in [(1, 30.0), (4, 2.0), (4, 30.0), (4, 60.0), (16, 90.0)] {
            let point = DVec3::new(31.3, 30.6, height);
            let [radiance, open] = seen(&octree, Opacity::Isotropic, &tracing(cones, degrees), (point, DVec3::Z));
            // Sums of up to 16 terms; irradiance is π times the mean.
            let off = (radiance * PI - PI).abs().max((open - 1.0).abs());
            assert!(off < 16.0 * f64::from(f32::EPSILON), "{raise}, {cones} cones of {degrees}°: {radiance}, {open}");
        }
    }
}

#[test]
fn a_slanting_plane_sees_all_of_the_sky() {
    let face = DVec3::new(0.3, -0.5, 0.8).normalize();
    let point = DVec3::new(31.3, 32.6, 30.9);
    // All cells that the plane cuts.
    let cuts = |cell: DVec3| (cell + 0.5 - point).dot(face).abs() <= 0.5 * face.abs().element_sum();
    let cells = (0..CELLS.pow(3)).map(|i| [i % CELLS, i / CELLS % CELLS, i / CELLS.pow(2)]);
    let cells = cells.filter(|cell| cuts(DVec3::from_array(cell.map(|c| c as f64))));
    let voxels = cells.map(|cell| Fragment {
        q: cell.map(|c| c * ONE),
        normal: [511, 511, 1022],
        albedo: [128; 3],
        coverage: 255,
    });
    let octree = built(voxels, |_| 0.0);
    for degrees in [2.0, 30.0, 60.0] {
        let [radiance, open] = seen(&octree, Opacity::Isotropic, &tracing(4, degrees), (point, face));
        assert!((radiance - 1.0).abs().max((open - 1.0).abs()) < 1e-5, "{degrees}°: {radiance}, {open}");
    }
}

/// The wall: all of the grid from x on, above the floor.
fn wall_corners(x: f64) -> [DVec3; 4] {
    let (low, high) = (FLOOR as f64, CELLS as f64);
    [[0.0, low], [high, low], [high, high], [0.0, high]].map(|[y, z]| DVec3::new(x, y, z))
}

#[test]
fn a_wall_hides_half_of_one_minus_the_cosine_of_its_height() {
    const WALL: i64 = 44;
    let octree = built(floor(0).chain(solid([WALL, 0, FLOOR], [WALL + 2, CELLS, CELLS], 0)), |_| 0.0);
    println!("share of the sky that a wall of two voxels hides; infinite: ½(1 − cos φ), φ = atan(h / d)");
    println!("aperture  opacity      distance  infinite  this wall  cones: 64 x 16, 16 x 16, 4 x 16, 1 x 16, 4");
    let mut rows = Vec::new();
    // A wide cone that goes up along the wall blends it with the air beside it, and stops: by so much it errs.
    for (degrees, opacity, errors) in [
        (4.0, Opacity::Isotropic, [0.014, 0.004, -0.003, -0.011]),
        (30.0, Opacity::Isotropic, [0.274, 0.216, 0.148, 0.052]),
        (30.0, Opacity::Directional, [0.211, 0.127, 0.091, 0.082]),
    ] {
        for (distance, error) in [4.0, 8.0, 16.0, 32.0].into_iter().zip(errors) {
            let point = DVec3::new(WALL as f64 - distance, 32.0, FLOOR as f64 + 0.5);
            let expected = form_factor(point, DVec3::Z, &wall_corners(WALL as f64));
            let infinite = 0.5 * (1.0 - ((CELLS as f64 - point.z) / distance).atan().cos());
            assert!(expected < infinite && expected > 0.6 * infinite);
            let sets = [(64, 4), (16, 4), (4, 4), (1, 4), (4, 1)];
            let hidden = sets.map(|(cones, pattern_px)| {
                let settings = ConeTracing { pattern_px, ..tracing(cones, degrees) };
                1.0 - seen(&octree, opacity, &settings, (point, DVec3::Z))[1]
            });
            rows.push(WallRow {
                aperture_degrees: degrees,
                opacity,
                distance_voxels: distance,
                infinite,
                closed: expected,
                hidden: sets
                    .map(|(cones, pattern_px)| cones * pattern_px * pattern_px)
                    .into_iter()
                    .zip(hidden)
                    .collect(),
            });
            let opacity = format!("{opacity:?}");
            println!("{degrees:7}°  {opacity:11}  {distance:8}  {infinite:8.3}  {expected:9.3}  {hidden:.3?}");
            let off = (hidden[0] - expected - error).abs();
            assert!(off < FORM_SLACK, "{degrees}°, {distance}: {hidden:?}, not {expected} and {error}");
            // Directions of equal weight: about as many as along the wall's edge, √n of n, may fall on the wrong
            // side of it. These are 0.16 to 0.32 of 1 / √n.
            for (fewer, off) in [(1, 0.01), (2, 0.02), (3, 0.08)] {
                assert!((hidden[fewer] - hidden[0]).abs() < off, "{degrees}°, {distance}: {hidden:?}");
            }
        }
    }
    measured::keep("walls.json", COMMAND, rows);
}

#[test]
fn the_sky_through_a_hole_is_its_form_factor() {
    const CEILING: i64 = 34;
    println!("sky through a square hole 25 voxels above a floor: its side, closed form, cones of 30° and of 4°");
    let mut rows = Vec::new();
    // Narrow cones lose what lies beside the rim, which blends with the hole; wide ones stop at it or see past it.
    for (side, errors) in [(12_i64, [0.035, 0.026]), (24, [-0.079, 0.028]), (40, [-0.187, 0.028])] {
        let (low, high) = (32 - side / 2, 32 + side / 2);
        let is_hole = |q: [i64; 3]| q.iter().take(2).all(|c| (low * ONE..high * ONE).contains(c));
        let ceiling = solid([0, 0, CEILING], [CELLS, CELLS, CEILING + 2], 0).filter(|voxel| !is_hole(voxel.q));
        let (last, end) = (CELLS - 2, CELLS);
        let sides = [([0, 0], [2, end]), ([last, 0], [end, end]), ([0, 0], [end, 2]), ([0, last], [end, end])];
        let walls = sides.into_iter().flat_map(|(a, b)| solid([a[0], a[1], FLOOR], [b[0], b[1], CEILING], 0));
        let octree = built(floor(0).chain(walls).chain(ceiling), |_| 0.0);
        let point = DVec3::new(32.0, 32.0, FLOOR as f64 + 0.5);
        let rim = [[low, low], [high, low], [high, high], [low, high]];
        let rim = rim.map(|[x, y]| DVec3::new(x as f64, y as f64, CEILING as f64 + 1.0));
        let expected = form_factor(point, DVec3::Z, &rim);
        let open =
            [30.0, 4.0].map(|degrees| seen(&octree, Opacity::Isotropic, &tracing(16, degrees), (point, DVec3::Z))[0]);
        rows.push(HoleRow { side_voxels: side, closed: expected, narrow: open[1], wide: open[0] });
        println!("{side:3}   {expected:.3}   {:.3} {:.3}", open[0], open[1]);
        for (open, error) in open.into_iter().zip(errors) {
            assert!((open - expected - error).abs() < FORM_SLACK, "{side}: {open}, not {expected} and {error}");
        }
    }
    measured::keep("holes.json", COMMAND, rows);
}

#[test]
fn constant_radiance_comes_back_whatever_is_occupied_how_much() {
    // All that is there is as bright as the sky.
    let octree = LitBuild::new(gpu(), &crate::random::scene(51, 2500, 5), &Shape::new(5, 2, Filter::Split), |_, a| {
        (DVec3::splat(5.0), a)
    });
    let photo = scattered();
    for (degrees, opacity) in [(2.0, Opacity::Isotropic), (30.0, Opacity::Isotropic), (90.0, Opacity::Directional)] {
        let cones = DiffuseCones::new(&tracing(4, degrees), 32, 0.25);
        let sampler = Sampler { opacity, ..Sampler::default() };
        let input = (&octree.sampled(Lookup::Ranks), &sampler);
        let found = diffuse(gpu(), input, &photo, (&cones, BOTH), ([5.0; 3], photo.size_px()));
        for (pixel, texel) in found.iter().zip(&photo.texels) {
            let expected = if texel.distance_cells < octolume::stages::pixels::NO_DEPTH { 5.0 } else { 0.0 };
            // Cones end with LEAST_LIGHT to go; each of some 60 steps rounds.
            assert!((f64::from(pixel[0]) - expected).abs() < 5.0 * (LEAST_LIGHT + 60.0 * 4.0 * 6e-8), "{pixel:?}");
        }
    }
}
