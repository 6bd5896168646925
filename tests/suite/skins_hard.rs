//! Skins that break viewers: scale inside the inverse bind matrices, a second set of joints, hundreds
//! of joints, mirrored instances, far away. CPU poses against matrices worked out by hand, and the
//! GPU's voxels against an exact voxelization of the pose.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, IVec3};
use octolume::engine::Engine;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::Scene;
use octolume::settings::VoxelizationMode;
use octolume::settings::{Discretization, Filter, Hidden, Settings};

use crate::device::open;
use crate::skin_rig::{ChainRig, Root};

/// Every hard rig, by name.
fn rigs() -> Vec<(&'static str, ChainRig)> {
    let mirrored = Root { translation: DVec3::new(-4.0, 0.0, 0.5), scale: DVec3::new(-1.0, 1.0, 1.0) };
    let upside_down = Root { translation: DVec3::new(0.25, 9.0, 4.0), scale: DVec3::new(1.0, -1.0, 1.0) };
    vec![
        ("bind scale 0.01", ChainRig { bind_scale: 0.01, ..ChainRig::new(4) }),
        ("bind scale 100", ChainRig { bind_scale: 100.0, ..ChainRig::new(4) }),
        ("JOINTS_1", ChainRig { in_second_set: true, ..ChainRig::new(4) }),
        ("300 joints", ChainRig::new(300)),
        ("mirrored", ChainRig { roots: vec![Root::at(DVec3::ZERO), mirrored, upside_down], ..ChainRig::new(4) }),
        ("far", ChainRig { roots: vec![Root::at(DVec3::new(1e6, -1e6, 1e6))], ..ChainRig::new(4) }),
    ]
}

fn opened(rig: &ChainRig) -> Scene {
    let scene = rig.document().open().expect("opens");
    assert_eq!(scene.warnings, [""; 0]);
    scene
}

/// How far a corner may be from where it is by hand. Roundings to f32 (2^-24 each) of the corner
/// and of the inverse bind matrix, which are as large as the chain is long; of every joint's
/// rotation, which turns all that follows; and the f64 of a place far away.
fn tolerance(rig: &ChainRig, root: &Root) -> f64 {
    let length = rig.joints as f64;
    let of_f32 = 2.0_f64.powi(-24) * length * (4.0 + 2.0 * length);
    of_f32 + 8.0 * f64::EPSILON * root.translation.abs().max_element()
}

#[test]
fn poses_are_those_worked_out_by_hand() {
    for (name, rig) in rigs() {
        let scene = opened(&rig);
        for (time_secs, is_bent) in [(0.0, false), (1.0, true)] {
            let pose = scene.pose(Some(0), time_secs);
            for (object, root) in scene.objects().iter().zip(&rig.roots) {
                let found = scene.posed_positions(object, 0, &pose);
                let boxes = rig.boxes_by_hand(root, is_bent);
                let tolerance = tolerance(&rig, root);
                // Flat normals unshare the corners: 36 a box, in the order of its triangles.
                assert_eq!(found.len(), 36 * boxes.len(), "{name}");
                for (place, (corners, _)) in found.chunks_exact(36).zip(&boxes) {
                    for position in place {
                        let off = corners.iter().map(|corner| corner.distance(*position)).fold(f64::INFINITY, f64::min);
                        assert!(off <= tolerance, "{name}, {time_secs} s: {position} is off by {off} > {tolerance}");
                    }
                }
            }
        }
    }
}

#[test]
fn normals_point_outwards_of_mirrored_chains_too() {
    for (name, rig) in rigs() {
        let scene = opened(&rig);
        let pose = scene.pose(Some(0), 1.0);
        for (object, root) in scene.objects().iter().zip(&rig.roots) {
            let (positions, normals) = (scene.posed_positions(object, 0, &pose), scene.posed_normals(object, 0, &pose));
            let middles = rig.boxes_by_hand(root, true).into_iter().flat_map(|(_, middle)| [middle; 36]);
            for ((position, normal), middle) in positions.iter().zip(&normals).zip(middles) {
                let (outward, length) = (normal.dot(*position - middle), normal.length());
                assert!(outward > 0.3 && (length - 1.0).abs() < 1e-6, "{name}: {normal} at {position} of {middle}");
            }
        }
    }
}

#[test]
fn eight_influences_become_the_four_strongest() {
    let weights = [0.05, 0.3, 0.1, 0.15, 0.2, 0.02, 0.08, 0.1_f32];
    let sets = [
        ([0, 1, 2, 3], [weights[0], weights[1], weights[2], weights[3]]),
        ([4, 5, 6, 7], [weights[4], weights[5], weights[6], weights[7]]),
    ];
    let scene = crate::document::Document::with_skin(8, &sets).open().expect("opens");
    let kept = [(1, 0.3), (4, 0.2), (3, 0.15), (2, 0.1)];
    let total: f64 = kept.iter().map(|(_, weight)| weight).sum();
    let mean: f64 = kept.iter().map(|(joint, weight)| f64::from(*joint) * weight / total).sum();
    let found = scene.posed_positions(&scene.objects()[0], 0, &scene.pose(None, 0.0))[0];
    assert!((found - DVec3::new(1.0 + mean, 0.0, 0.0)).abs().max_element() < 8.0 * f64::from(f32::EPSILON), "{found}");
    assert!(
        scene.warnings.iter().any(|warning| warning.sentence.contains("more than 4 joints")),
        "{:?}",
        scene.warnings
    );
}

fn prepared(scene: Scene, grid: u32) -> Prepared {
    let mode = VoxelizationMode::Conservative;
    let discretization = Discretization { grid, mode, filter: Filter::Nearest, ..Discretization::default() };
    prepare(Arc::new(scene), &discretization, None, &Progress::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Cells that the GPU fills with the pose at the end of the clip.
fn moved_cells(engine: &mut Engine, prepared: &Arc<Prepared>, settings: &Settings) -> BTreeSet<[i32; 3]> {
    engine.set_prepared(Some(Arc::clone(prepared)));
    engine.request(settings, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
    engine.run_to_end().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(engine.left_out(), [""; 0]);
    engine.read_voxels().unwrap_or_else(|error| panic!("{error}")).cells.into_iter().collect()
}

fn cell_of(key: u32) -> [i32; 3] {
    let axis = |axis: u32| (0..10).map(|bit| (key >> (3 * bit + axis) & 1) << bit).sum::<u32>() as i32;
    [axis(0), axis(1), axis(2)]
}

fn has_neighbour(cells: &BTreeSet<[i32; 3]>, cell: [i32; 3]) -> bool {
    let near = |offset: i32| IVec3::from(cell) + IVec3::new(offset % 3, offset / 3 % 3, offset / 9) - IVec3::ONE;
    (0..27).any(|offset| cells.contains(&near(offset).to_array()))
}

/// A covered cell holds a point of the surface. Where the object was voxelized, that point lies in a
/// voxel, so half a cell's diagonal (0.87 cells) from its centre at most; a joint that turns keeps
/// that distance, and the nearest filter puts the centre into the cell it falls in: the same or a
/// neighbour. The same holds the other way round.
#[test]
fn moved_voxels_are_where_the_surface_is() {
    let mut engine = Engine::new(Arc::new(open()));
    for (name, rig) in rigs() {
        let grid = if rig.joints > 64 { 256 } else { 64 };
        let prepared = Arc::new(prepared(opened(&rig), grid));
        let mut settings = Settings::default();
        settings.method.discretization = Discretization {
            grid,
            mode: VoxelizationMode::Conservative,
            filter: Filter::Nearest,
            ..settings.method.discretization
        };
        settings.shot.motion.clip = Some("bend".to_owned());
        settings.shot.motion.time_secs = 1.0;
        settings.method.look.view = octolume::settings::View::Voxels;
        let moved = moved_cells(&mut engine, &prepared, &settings);
        let exact = prepared
            .exact_voxels(&settings.shot.motion, &Hidden::default(), &Progress::default())
            .expect("not cancelled");
        let exact: BTreeSet<[i32; 3]> = exact.voxels.iter().map(|voxel| cell_of(voxel.key)).collect();
        assert!(exact.len() > 300, "{name}: {} cells", exact.len());
        let holes = exact.iter().filter(|&&cell| !has_neighbour(&moved, cell)).count();
        let spill = moved.iter().filter(|&&cell| !has_neighbour(&exact, cell)).count();
        assert_eq!((holes, spill), (0, 0), "{name}: of {} exact and {} moved cells", exact.len(), moved.len());
    }
}

/// For `tests/models/hard_skins.sh`, which draws them.
#[test]
fn rigs_are_written_as_files() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hard_skins");
    std::fs::create_dir_all(&folder).expect("a folder");
    for (name, rig) in rigs() {
        let file = folder.join(format!("{name}.glb"));
        std::fs::write(&file, rig.document().glb()).expect("written");
        let scene = octolume::scene::load::open(&file, &Progress::default()).expect("opens");
        assert_eq!(scene.objects().len(), rig.roots.len(), "{name}");
    }
}
