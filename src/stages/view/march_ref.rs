//! Reference of `march`: a ray's crossings by their definition, sorted, and the blend of Fig. 8.
//!
//! A ray crosses a cell where its points lie inside for some length; cells are half-open. Nothing
//! is skipped and nothing ends early.

use glam::{DVec3, IVec3};

use crate::color::gamma_from_linear;
use crate::settings::AlphaRule;
use crate::stages::pixels::camera::PixelRay;
use crate::stages::pixels::crossings::{Crossing, crossings};
use crate::stages::pixels::{AMBIENT, EDGE_FROM_PX, EDGE_FULL_PX, EDGE_SHADE, SHORT_NORMAL};

/// What a cell shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnCell {
    pub occupancy: f64,
    /// Linear.
    pub color: DVec3,
    pub normal: DVec3,
    /// False for measured colours.
    pub shaded: bool,
}

/// How crossings become a colour.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    pub alpha: AlphaRule,
    pub edges: bool,
    /// Leaf cells a cell of the shown level.
    pub scale: f64,
    /// Linear.
    pub background: DVec3,
}

/// Alpha of a voxel of occupancy `a` crossed over `length_cells` leaf cells.
pub fn alpha(rule: AlphaRule, a: f64, length_cells: f64) -> f64 {
    match rule {
        AlphaRule::Paper => a,
        AlphaRule::Length => 1.0 - (1.0 - a).powf(length_cells),
    }
}

/// A pixel: gamma-encoded colour, and the distance in cells to where half is stopped.
/// `cells`: of the shown level, an axis.
pub fn pixel(
    ray: &PixelRay,
    cells: u32,
    rules: &Rules,
    shown: impl Fn(IVec3) -> Option<DrawnCell>,
) -> (DVec3, Option<f64>) {
    let (mut color, mut through, mut depth_cells) = (DVec3::ZERO, 1.0, None);
    for crossing in crossings(ray.origin / rules.scale, ray.direction, cells) {
        let Some(voxel) = shown(crossing.cell) else { continue };
        let mut seen = headlit(&voxel, &crossing, ray.direction);
        if rules.edges {
            seen *= edge_shade(ray, &crossing, rules.scale);
        }
        let stopped = alpha(rules.alpha, voxel.occupancy, (crossing.to - crossing.from) * rules.scale);
        color += seen * (through * stopped);
        let after = through * (1.0 - stopped);
        if through >= 0.5 && after < 0.5 {
            depth_cells = Some(ray.start_cells + crossing.from * rules.scale);
        }
        through = after;
    }
    let linear = color + rules.background * through;
    (DVec3::from_array(linear.to_array().map(gamma_from_linear)), depth_cells)
}

fn headlit(voxel: &DrawnCell, crossing: &Crossing, direction: DVec3) -> DVec3 {
    let normal = if voxel.normal.length() < SHORT_NORMAL { crossing.entered } else { voxel.normal };
    match normal.try_normalize() {
        Some(normal) if voxel.shaded => voxel.color * (AMBIENT + (1.0 - AMBIENT) * normal.dot(direction).abs()),
        _ => voxel.color,
    }
}

/// What a line along the cell's border leaves of the colour, where the ray enters.
fn edge_shade(ray: &PixelRay, crossing: &Crossing, scale: f64) -> f64 {
    if crossing.entered == DVec3::ZERO {
        return 1.0;
    }
    let pixel = ray.width / scale + crossing.from * ray.widening;
    let inside = ray.origin / scale + ray.direction * crossing.from - crossing.cell.as_dvec3();
    let distances =
        (0..3).filter(|&axis| crossing.entered[axis] == 0.0).map(|axis| inside[axis].min(1.0 - inside[axis]));
    let distance_px = distances.fold(1.0, f64::min) / pixel;
    let fade = ((1.0 / pixel - EDGE_FROM_PX) / (EDGE_FULL_PX - EDGE_FROM_PX)).clamp(0.0, 1.0);
    1.0 - (1.0 - EDGE_SHADE) * (1.5 - distance_px).clamp(0.0, 1.0) * fade
}
