//! The closed furnace: a room whose walls all emit 1 and reflect ρ has radiance 1 / (1 − ρ) everywhere
//! once light has gone on often enough, however it is built. Tables as JSON where `OCTOLUME_MEASURED` names a folder.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;
use octolume::settings::Filter;
use octolume::settings::lighting::Opacity;
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::light::gather::{Cones, Gathered};
use serde::{Deserialize, Serialize};

use crate::cones::gathered;
use crate::device::gpu;
use crate::doc_tables::measured;
use crate::lit_octree::LitBuild;
use crate::octree_rules::Cell;
use crate::random::ONE;
use crate::stage_build::Shape;

const DEPTH: u32 = 5;
const CELLS: u32 = 32;
const COMMAND: &str = "cargo test --test suite furnace";

/// Radiance of a furnace that emits 1.
#[derive(Serialize, Deserialize)]
pub struct FurnaceRow {
    pub thickness: u32,
    pub opacity: Opacity,
    pub albedo: f64,
    pub aperture_degrees: f64,
    pub closed: f64,
    /// Of the faces of the room, away from its edges.
    pub mean: f64,
    pub least: f64,
    pub most: f64,
}

impl FurnaceRow {
    fn new(thickness: u32, (albedo, aperture_degrees): (f64, f64), opacity: Opacity, bounces: usize) -> Self {
        let radiance = furnace(thickness, albedo, aperture_degrees, opacity, bounces);
        let (least, most) = spread(&radiance);
        let inner = |c: &u32| (6..26).contains(c);
        let faces = radiance.iter().filter(|(cell, _)| cell[0] == thickness - 1 && cell[1..].iter().all(inner));
        let faces: Vec<f64> = faces.map(|(_, l)| *l).collect();
        let mean = faces.iter().sum::<f64>() / faces.len() as f64;
        Self { thickness, opacity, albedo, aperture_degrees, closed: 1.0 / (1.0 - albedo), mean, least, most }
    }
}

/// Walls of `thickness` voxels around the grid, normals to the inside.
fn room(thickness: u32) -> Vec<Fragment> {
    let inward = |c: u32| {
        if c < thickness {
            1.0
        } else if c >= CELLS - thickness {
            -1.0
        } else {
            0.0
        }
    };
    let cells = (0..CELLS.pow(3)).map(|i| [i % CELLS, i / CELLS % CELLS, i / CELLS.pow(2)]);
    let voxel = |cell: Cell| {
        let normal = DVec3::from_array(cell.map(inward)).try_normalize()?;
        let normal = (normal * 511.0 + 511.0).round().to_array().map(|c| c as u32);
        Some(Fragment { q: cell.map(|c| i64::from(c) * ONE), normal, albedo: [255; 3], coverage: 255 })
    };
    cells.filter_map(voxel).collect()
}

/// Radiance of every leaf after so many bounces: L = 1 + ρ · E / π, E gathered by cones.
fn furnace(
    thickness: u32,
    albedo: f64,
    aperture_degrees: f64,
    opacity: Opacity,
    bounces: usize,
) -> BTreeMap<Cell, f64> {
    let cones = Cones { count: 8, aperture_degrees, ..Cones::default() };
    let mut octree =
        LitBuild::new(gpu(), &room(thickness), &Shape::new(DEPTH, 3, Filter::Nearest), |_, a| (DVec3::ONE, a));
    let mut radiance = BTreeMap::new();
    for _ in 0..bounces {
        let arriving = gathered(gpu(), &octree, Gathered::Bounce, &cones, opacity);
        radiance = arriving.into_iter().map(|(cell, e)| (cell, 1.0 + albedo * e.x / PI)).collect();
        octree.relight(gpu(), |cell, a| (DVec3::splat(radiance[&cell]), a));
    }
    radiance
}

fn spread(radiance: &BTreeMap<Cell, f64>) -> (f64, f64) {
    radiance.values().fold((f64::INFINITY, 0.0), |(least, most), l| (l.min(least), l.max(most)))
}

#[test]
fn a_closed_furnace_glows_evenly_at_narrow_apertures() {
    let mut rows = Vec::new();
    for (albedo, aperture, bounces) in [(0.5, 0.0, 9), (0.8, 2.0, 26)] {
        let row = FurnaceRow::new(4, (albedo, aperture), Opacity::Isotropic, bounces);
        let FurnaceRow { closed, least, most, .. } = row;
        rows.push(row);
        println!("ρ {albedo}, {aperture}°: {least:.4} to {most:.4}, closed form {closed:.4}");
        // What the bounces after the last would add, and 1 % for what cones leave unseen.
        let missing = albedo.powi(bounces as i32 + 1) / (1.0 - albedo);
        assert!(least > 0.99 * closed - missing && most < 1.01 * closed, "{least} to {most}, not {closed}");
    }
    measured::keep("furnace-narrow.json", COMMAND, rows);
}

#[test]
fn wide_cones_leak_out_of_the_furnace_and_never_add_light() {
    println!("radiance of a furnace's faces, ρ ½, closed form 2, and of the darkest and brightest leaf:");
    let mut rows = Vec::new();
    for (thickness, aperture) in [(1, 30.0), (2, 30.0), (4, 30.0)] {
        for opacity in [Opacity::Isotropic, Opacity::Directional] {
            let row = FurnaceRow::new(thickness, (0.5, aperture), opacity, 10);
            let FurnaceRow { mean, least, most, .. } = row;
            rows.push(row);
            println!("walls of {thickness}, {aperture}°, {opacity:?}: {mean:.3}, {least:.3} to {most:.3}");
            assert!(most < 2.0 * 1.0001, "energy cannot grow: {most}");
        }
    }
    measured::keep("furnace-wide.json", COMMAND, rows);
}
