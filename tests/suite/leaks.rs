//! What thin walls let through at each level: closed forms where there are any, and a table
//! (`--nocapture`; as JSON where `OCTOLUME_MEASURED` names a folder).

use std::collections::BTreeMap;

use glam::DVec3;
use octolume::settings::lighting::Opacity;
use octolume::settings::{Filter, Lookup, Sampling};
use octolume::stages::fill::gather_ref::Fragment;
use octolume::stages::sample::Sampler;
use serde::{Deserialize, Serialize};

use crate::device::gpu;
use crate::doc_tables::measured;
use crate::lit_octree::LitBuild;
use crate::random::ONE;
use crate::stage_build::Shape;

const DEPTH: u32 = 5;
const CELLS: i64 = 32;
/// Where the walls begin: at a node's border at every level.
const FIRST: i64 = 16;

/// What a wall across x lets through of a march.
#[derive(Serialize, Deserialize)]
pub struct LeakRow {
    pub thickness: i64,
    pub offset_cells: f64,
    pub opacity: Opacity,
    /// By the width of the nodes sampled, cells: at their centres, and half-way between them.
    pub transmission: BTreeMap<u32, [f64; 2]>,
}

/// Across x, `thickness` voxels thick, shifted by `offset` 256ths of a cell and split.
fn wall(thickness: i64, offset: i64) -> LitBuild {
    let voxel = |i: i64| {
        let (x, y, z) = (FIRST + i % thickness, i / thickness % CELLS, i / (thickness * CELLS));
        Fragment { q: [x * ONE + offset, y * ONE, z * ONE], normal: [1022, 511, 511], albedo: [255; 3], coverage: 255 }
    };
    let voxels: Vec<_> = (0..thickness * CELLS * CELLS).map(voxel).collect();
    LitBuild::new(gpu(), &voxels, &Shape::new(DEPTH, 2, Filter::Split), |_, a| (DVec3::ONE, a))
}

/// Opacity of the wall's layers of cells.
fn layers(thickness: i64, offset: i64) -> Vec<f64> {
    let share = offset as f64 / ONE as f64;
    let full = std::iter::repeat_n(1.0, thickness as usize - 1);
    std::iter::once(1.0 - share).chain(full).chain((offset > 0).then_some(share)).collect()
}

/// Transmission of a march straight through at a level, a step a node: 1 − α a leaf cell of length.
/// `phase`: where in a node it samples, ½ the centre.
fn transmission(wall: &LitBuild, opacity: Opacity, level: u32, phase: f32) -> f64 {
    let nodes = 1 << level;
    let width = (CELLS / nodes) as f32;
    let middle = (0.5 + (nodes / 2) as f32) * width;
    let points: Vec<_> = (0..=nodes).map(|i| [(i as f32 + phase) * width, middle, middle, level as f32]).collect();
    let sampler = Sampler { sampling: Sampling::Trilinear, lookup: Lookup::Ranks, opacity };
    let samples = wall.sample(gpu(), &sampler, DVec3::X, &points);
    samples.iter().map(|sample| (1.0 - f64::from(sample[3])).powf(width.into())).product()
}

/// The same at node centres in closed form. Isotropic: each node spreads what it holds over its width.
/// Directional: what is behind one another multiplies, so that no level lets through more than the leaves.
fn expected(layers: &[f64], opacity: Opacity, level: u32) -> f64 {
    if opacity == Opacity::Directional {
        return layers.iter().map(|layer| 1.0 - layer).product();
    }
    let width = (CELLS >> level) as usize;
    let through = |node: &[f64]| (1.0 - node.iter().sum::<f64>() / width as f64).powf(width as f64);
    layers.chunks(width).map(through).product()
}

#[test]
fn walls_let_through_what_the_closed_forms_say_at_every_level() {
    println!("transmission of a wall across x, by the width of the nodes that are sampled (cells):");
    println!("sampled at node centres, and half-way between them");
    println!("voxels  offset  opacity      |         1 |         2 |         4 |         8 |        16 |        32");
    let mut rows = Vec::new();
    for thickness in [1, 2, 4] {
        for offset in [0, ONE / 4, ONE / 2] {
            let wall = wall(thickness, offset);
            for opacity in [Opacity::Isotropic, Opacity::Directional] {
                let mut row =
                    format!("{thickness:6}  {:6.2}  {:11} ", offset as f64 / ONE as f64, format!("{opacity:?}"));
                let mut transmitted = BTreeMap::new();
                for level in (0..=DEPTH).rev() {
                    let [centre, between] = [0.5, 0.0].map(|phase| transmission(&wall, opacity, level, phase));
                    transmitted.insert(1 << (DEPTH - level), [centre, between]);
                    row += &format!(" | {centre:.2} {between:.2}");
                    let closed = expected(&layers(thickness, offset), opacity, level);
                    // α comes from an f32 near 1 to the power of 1/w and goes into one to the power of w: 2^-24
                    // of itself w times, and once what rounding leaves of 1 − 1.
                    assert!(
                        (centre - closed).abs() < 1e-5,
                        "{thickness} voxels, {offset}, {opacity:?}, level {level}: {centre}, not {closed}"
                    );
                }
                println!("{row}");
                let offset_cells = offset as f64 / ONE as f64;
                rows.push(LeakRow { thickness, offset_cells, opacity, transmission: transmitted });
            }
        }
    }
    measured::keep("leaks.json", "cargo test --test suite leaks", rows);
}

#[test]
fn an_aligned_wall_is_opaque_along_its_axis_at_every_level() {
    let thin = wall(1, 0);
    for level in 0..=DEPTH {
        // Of what stops all, 2^-24 is left.
        assert!(transmission(&thin, Opacity::Directional, level, 0.5) < 1e-6);
        // The paper's way: the whole grid's worth of air thins it out.
        let width = f64::from(1_u32 << (DEPTH - level));
        let isotropic = transmission(&thin, Opacity::Isotropic, level, 0.5);
        assert!((isotropic - (1.0 - 1.0 / width).powf(width)).abs() < 1e-5);
    }
    // Half-way between two leaf centres both samples see half of the wall.
    assert_eq!(transmission(&thin, Opacity::Isotropic, DEPTH, 0.0), 0.25);
}
