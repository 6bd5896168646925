//! How right the shadows in the voxels are: what rays through the posed triangles say of points on them,
//! beside what the leaf says that each point lies in.
//!
//! Truth of a point: the light reaches it, or something lies between. Found: irradiance of its leaf with
//! shadows over that without, 0 to 1. Points whose shading normal does not face the light by
//! [`LEAST_FACING_DEGREES`] are left out: there shading, not shadow, decides. A leaf is a cell wide, so
//! along every border of a shadow some error is left, whatever the method.

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::posed_triangles::{PosedTriangles, SurfacePoint};
use crate::color::luminance;
use crate::data::grid::{Grid, morton_key};
use crate::data::world_voxels::WorldVoxels;
use crate::lights::PosedLight;
use crate::scene::LightKind;
use crate::stages::light::illuminate_ref::{self, Light, Source};

/// Points that are spread over the triangles of a pose.
pub const POINTS: usize = 200_000;
pub const LEAST_FACING_DEGREES: f64 = 5.0;
/// A leaf with less light than this share is dark.
const LIT_FROM: f64 = 0.5;

/// Inverse powers of the plastic number: steps of a sequence that fills the square evenly.
const SQUARE_STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// About `count` points, evenly by area; fewer where surfaces have holes. The same for the same triangles.
pub fn spread(triangles: &PosedTriangles, count: usize) -> Vec<SurfacePoint> {
    let mut total = 0.0;
    let ends: Vec<f64> = triangles
        .areas()
        .map(|area| {
            total += area;
            total
        })
        .collect();
    let point = |index: usize| {
        let along = total * (index as f64 + 0.5) / count as f64;
        let triangle = ends.partition_point(|&end| end <= along);
        let [u, v] = SQUARE_STEPS.map(|step| (0.5 + index as f64 * step).fract());
        let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
        if triangle < triangles.len() { triangles.point(triangle, DVec3::new(1.0 - u - v, u, v)) } else { None }
    };
    (0..count).into_par_iter().filter_map(point).collect()
}

/// Which leaf lies where.
pub struct LeafPlaces {
    /// Morton keys, ascending: the order of the leaves.
    keys: Vec<u32>,
    cells: f64,
}

impl LeafPlaces {
    pub fn new(voxels: &WorldVoxels, grid: &Grid) -> Self {
        let keys = voxels.cells.iter().map(|cell| morton_key(cell.map(|c| c as u32))).collect();
        Self { keys, cells: f64::from(grid.cells()) }
    }

    /// `None` in a cell that is empty, or not in the grid.
    fn leaf(&self, position: DVec3) -> Option<u32> {
        let is_inside = position.min_element() >= 0.0 && position.max_element() < self.cells;
        let key = || morton_key(position.to_array().map(|c| c as u32));
        is_inside.then(|| self.keys.binary_search(&key()).ok().map(|leaf| leaf as u32)).flatten()
    }
}

/// What rays say of the points that face a light.
pub struct TrueShadows {
    points: Vec<TruePoint>,
}

struct TruePoint {
    leaf: Option<u32>,
    is_lit: bool,
}

impl TrueShadows {
    pub fn new(
        triangles: &PosedTriangles,
        points: &[SurfacePoint],
        light: &PosedLight,
        grid: &Grid,
        leaves: &LeafPlaces,
    ) -> Self {
        let light = Light { source: source(light, grid), strength: DVec3::ONE };
        let facing = points.par_iter().filter(|point| arrives(&light, point));
        let truth = facing.map(|point| TruePoint {
            leaf: leaves.leaf(point.position),
            is_lit: !is_hidden(triangles, point, light.source),
        });
        Self { points: truth.collect() }
    }

    /// Both irradiances leaf by leaf: with shadows, and with none.
    pub fn compare(&self, shadowed: &[[f32; 3]], open: &[[f32; 3]]) -> ShadowError {
        let mut sums = Sums::default();
        let at = |leaf: Option<u32>| leaf.and_then(|leaf| shadowed.get(leaf as usize).zip(open.get(leaf as usize)));
        for point in &self.points {
            let Some((shadowed, open)) = at(point.leaf) else {
                sums.without_leaf += 1;
                continue;
            };
            let [shadowed, open] = [shadowed, open].map(|lux| luminance(lux.map(f64::from)));
            if open > 0.0 {
                sums.add(point.is_lit, shadowed / open, open);
            } else {
                sums.turned_away += 1;
            }
        }
        sums.report()
    }
}

/// In cells.
fn source(light: &PosedLight, grid: &Grid) -> Source {
    let position = grid.grid_from_world().transform_point3(light.position);
    let cells = |range: Option<f32>| range.map(|range| f64::from(range) / grid.span);
    match light.kind {
        LightKind::Directional => Source::Sun(light.direction),
        LightKind::Point { range } => Source::Point(position, cells(range)),
        LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
            let cosines = [inner_cone_radians, outer_cone_radians].map(|angle| f64::from(angle).cos());
            Source::Spot(position, light.direction, cosines, cells(range))
        }
    }
}

/// The point faces the light, and lies within its range and cone.
fn arrives(light: &Light, point: &SurfacePoint) -> bool {
    let (to_light, _) = illuminate_ref::towards(light.source, point.position);
    let faces = point.shading.dot(to_light) > LEAST_FACING_DEGREES.to_radians().sin() * to_light.length();
    faces && illuminate_ref::irradiance(light, point.position, point.shading, 1.0).x > 0.0
}

fn is_hidden(triangles: &PosedTriangles, point: &SurfacePoint, source: Source) -> bool {
    match source {
        Source::Sun(direction) => triangles.is_hidden(point.start(-direction), -direction, f64::INFINITY),
        Source::Point(position, _) | Source::Spot(position, ..) => {
            let from = point.start(position - point.position);
            let to_light = position - from;
            // In the light itself nothing is between.
            to_light.try_normalize().is_some_and(|way| triangles.is_hidden(from, way, to_light.length()))
        }
    }
}

/// Shares are percent of `points`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ShadowError {
    /// Points that face the light and lie in a leaf that does.
    pub points: u64,
    /// Points beside these whose cell holds no leaf.
    pub without_leaf: u64,
    /// Points beside these whose leaf, a mean over its cell, faces away from the light.
    pub turned_away: u64,
    /// Lit in truth.
    pub lit_percent: f64,
    /// Mean difference of what is found and the truth.
    pub mean_error_percent: f64,
    /// Lit in truth, dark in the leaf.
    pub lost_percent: f64,
    /// Dark in truth, lit in the leaf.
    pub leaked_percent: f64,
    /// Mean irradiance of the points' leaves without shadows.
    pub open_lux: f64,
}

impl ShadowError {
    /// Of several lights: shares weighted by the light that each sends to its points.
    pub fn of_all(lights: &[Self]) -> Self {
        let weight = |light: &Self| light.open_lux * light.points as f64;
        let total: f64 = lights.iter().map(weight).sum();
        let mean = |share: fn(&Self) -> f64| {
            let sum: f64 = lights.iter().map(|light| weight(light) * share(light)).sum();
            if total > 0.0 { sum / total } else { 0.0 }
        };
        let points = lights.iter().map(|light| light.points).sum();
        Self {
            points,
            without_leaf: lights.iter().map(|light| light.without_leaf).sum(),
            turned_away: lights.iter().map(|light| light.turned_away).sum(),
            lit_percent: mean(|light| light.lit_percent),
            mean_error_percent: mean(|light| light.mean_error_percent),
            lost_percent: mean(|light| light.lost_percent),
            leaked_percent: mean(|light| light.leaked_percent),
            open_lux: if points > 0 { total / points as f64 } else { 0.0 },
        }
    }
}

#[derive(Default)]
struct Sums {
    points: u64,
    without_leaf: u64,
    turned_away: u64,
    lit: u64,
    lost: u64,
    leaked: u64,
    error: f64,
    open: f64,
}

impl Sums {
    fn add(&mut self, is_lit: bool, found: f64, open: f64) {
        let seems_lit = found >= LIT_FROM;
        self.points += 1;
        self.lit += u64::from(is_lit);
        self.lost += u64::from(is_lit && !seems_lit);
        self.leaked += u64::from(!is_lit && seems_lit);
        self.error += (found - f64::from(u8::from(is_lit))).abs();
        self.open += open;
    }

    fn report(&self) -> ShadowError {
        let mean = |sum: f64| if self.points > 0 { sum / self.points as f64 } else { 0.0 };
        let percent = |count: u64| super::percent(count, self.points);
        ShadowError {
            points: self.points,
            without_leaf: self.without_leaf,
            turned_away: self.turned_away,
            lit_percent: percent(self.lit),
            mean_error_percent: mean(100.0 * self.error),
            lost_percent: percent(self.lost),
            leaked_percent: percent(self.leaked),
            open_lux: mean(self.open),
        }
    }
}
