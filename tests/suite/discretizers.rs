//! Moving voxels beside voxelizing the posed triangles every frame, through the engine.

use std::sync::Arc;

use glam::DVec3;
use octolume::data::grid::morton_key;
use octolume::data::world_voxels::WorldVoxels;
use octolume::engine::Engine;
use octolume::plan::Pass;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{builtin, load};
use octolume::settings::{Discretizer, Settings, VoxelizerCells};

use crate::device;
use crate::real_scenes::real_scenes;

fn settings(cells: VoxelizerCells, grid: u32, time_secs: f64) -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = grid;
    settings.method.discretization.discretizer = Discretizer::Voxelize;
    settings.method.discretization.cells = cells;
    settings.shot.motion.time_secs = time_secs;
    settings
}

pub fn voxels(engine: &mut Engine, settings: &Settings) -> WorldVoxels {
    engine.request(settings, [16, 16]).expect("a request");
    engine.run_to_end().expect("a frame");
    engine.read_voxels().expect("an octree")
}

/// The order of fragments, the way to find them and the room for them change no bit.
#[test]
fn the_same_octree_whatever_finds_the_fragments() {
    let prepared = Arc::new(courtyard());
    let first = settings(VoxelizerCells::Sparse, 64, 2.5);
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::clone(&prepared)));
    let expected = voxels(&mut engine, &first);
    assert!(expected.cells.len() > 20_000);
    assert_eq!(voxels(&mut engine, &settings(VoxelizerCells::Dense, 64, 2.5)), expected);
    let mut short = Engine::new(Arc::new(device::open()));
    short.set_prepared(Some(prepared));
    short.underestimate(0.4);
    voxels(&mut short, &settings(VoxelizerCells::Sparse, 64, 5.0));
    assert_eq!(voxels(&mut short, &first), expected);
}

#[test]
fn a_still_scene_is_voxelized_once() {
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(courtyard())));
    let settings = settings(VoxelizerCells::Sparse, 64, 1.0);
    engine.request(&settings, [16, 16]).expect("a request");
    assert!(engine.plan().runs(Pass::MergeFragments) && !engine.plan().runs(Pass::TransformRigid));
    engine.run_to_end().expect("a frame");
    engine.request(&settings, [16, 16]).expect("a request");
    assert!(engine.plan().is_idle());
}

fn courtyard() -> Prepared {
    let bytes = builtin::bytes("courtyard").expect("a known name");
    let scene = load::open_bytes("courtyard", bytes, None, &Progress::default()).expect("opens");
    let settings = settings(VoxelizerCells::Sparse, 64, 0.0);
    prepare(Arc::new(scene), &settings, None, &Progress::default()).expect("it fits")
}

/// A thousandth of a cell: f32 places what is up to 64 cells from the corner to 2^-19 of a cell a rounding, of which
/// matrices and predicates make some hundred.
const APART_CELLS: f64 = 1e-3;

/// A bit a cell that is covered wherever within [`APART_CELLS`] the grid lies, and one that is where it lies somewhere.
fn sure_and_possible(prepared: &mut Prepared, settings: &Settings) -> [Vec<u32>; 2] {
    let pose = prepared.pose(&settings.shot.motion).expect("poses");
    let hidden = prepared.hidden(&settings.shot.visibility, &pose).expect("known");
    let corners = (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0 - 1.0);
    let shifts = corners.chain([DVec3::ZERO]);
    let anchor = prepared.grid.anchor;
    let sets = shifts.map(|shift| {
        prepared.grid.anchor = anchor + shift * APART_CELLS * prepared.grid.span;
        let exact = prepared.exact(&settings.shot.motion, &hidden, &Progress::default());
        exact.expect("exact voxels").bits
    });
    let mut sets = sets.collect::<Vec<_>>().into_iter();
    prepared.grid.anchor = anchor;
    let first = sets.next().expect("one");
    sets.fold([first.clone(), first], |[sure, possible], set| {
        let both = |a: Vec<u32>, how: fn(u32, u32) -> u32| a.into_iter().zip(&set).map(|(a, b)| how(a, *b)).collect();
        [both(sure, |a, b| a & b), both(possible, |a, b| a | b)]
    })
}

pub fn assert_exact(name: &str, mut prepared: Prepared, settings: &Settings) {
    let [sure, possible] = sure_and_possible(&mut prepared, settings);
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    let mut found = vec![0_u32; sure.len()];
    for cell in voxels(&mut engine, settings).cells {
        let key = morton_key(cell.map(|c| c as u32));
        found[key as usize / 32] |= 1 << (key % 32);
    }
    let count = |words: &mut dyn Iterator<Item = u32>| words.map(u32::count_ones).sum::<u32>();
    let lost = count(&mut sure.iter().zip(&found).map(|(sure, found)| sure & !found));
    let added = count(&mut possible.iter().zip(&found).map(|(possible, found)| found & !possible));
    let all = count(&mut found.iter().copied());
    println!("{name}: {all} cells, {lost} lost, {added} added, {} sure", count(&mut sure.iter().copied()));
    assert!(all > 1_000 && (lost, added) == (0, 0), "{name}: {lost} lost and {added} added of {all}");
}

#[test]
fn cells_are_those_of_the_exact_voxelization_but_for_rounding() {
    let settings = settings(VoxelizerCells::Sparse, 64, 2.5);
    assert_exact("courtyard", courtyard(), &settings);
    let Some(folder) = real_scenes() else { return };
    for (file, time) in
        [("Fox/Fox.glb", 1.7), ("CesiumMan/CesiumMan.glb", 0.9), ("AnimatedMorphCube/AnimatedMorphCube.glb", 1.3)]
    {
        let scene = load::open(&folder.join(file), &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
        let mut settings = settings.clone();
        settings.shot.motion.time_secs = time;
        let prepared = prepare(Arc::new(scene), &settings, None, &Progress::default()).expect("it fits");
        assert_exact(file, prepared, &settings);
    }
}
