//! What `voxels` and `make` write: the numbers promised, and the same bytes every time.

use std::ffi::OsStr;
use std::fs;
use std::io::Cursor;
use std::path::Path;

use ndarray::{Array0, Array1, Array2};
use ndarray_npy::NpzReader;
use octolume::data::grid::morton_key;
use octolume::scene::builtin;

use crate::scenes::Scenes;
use crate::{json, octolume, succeed};

pub fn voxels(scene: &Path, file: &Path, options: &[&str]) -> Vec<u8> {
    let start = [OsStr::new("voxels"), scene.as_os_str(), OsStr::new("-o"), file.as_os_str()];
    succeed(start.into_iter().chain(options.iter().map(OsStr::new)));
    fs::read(file).expect("a file")
}

pub struct Arrays {
    cells: Array2<i32>,
    occupancy: Array1<f32>,
    pub albedo: Array2<f32>,
    normal: Array2<f32>,
    corner: Array1<f64>,
    span: Array0<f64>,
}

pub fn arrays(bytes: &[u8]) -> Arrays {
    let mut npz = NpzReader::new(Cursor::new(bytes)).expect("an archive");
    let mut triples = |name| npz.by_name(name).expect("a float array");
    let (albedo, normal) = (triples("albedo"), triples("normal"));
    Arrays {
        cells: npz.by_name("cells").expect("int32 [n, 3]"),
        occupancy: npz.by_name("occupancy").expect("float32 [n]"),
        albedo,
        normal,
        corner: npz.by_name("grid_corner").expect("float64 [3]"),
        span: npz.by_name("span").expect("float64"),
    }
}

#[test]
fn arrays_are_sorted_complete_and_in_range() {
    let scenes = Scenes::new();
    for scene in [scenes.turning_box(), scenes.bent_box()] {
        let bytes = voxels(&scene, &scenes.path("out.npz"), &["--time", "0.7", "--span", "0.125"]);
        let arrays = arrays(&bytes);
        let count = arrays.cells.nrows();
        assert!(count > 1000, "{count} cells");
        assert_eq!((arrays.albedo.dim(), arrays.normal.dim()), ((count, 3), (count, 3)));
        assert_eq!((arrays.occupancy.len(), arrays.corner.len()), (count, 3));
        assert_eq!(arrays.span.into_scalar(), 0.125);
        assert!(arrays.cells.iter().all(|cell| (0..64).contains(cell)));
        let keys =
            arrays.cells.rows().into_iter().map(|cell| morton_key([cell[0], cell[1], cell[2]].map(|c| c as u32)));
        assert!(keys.collect::<Vec<_>>().is_sorted_by(|a, b| a < b), "not in Morton order");
        assert!(arrays.occupancy.iter().all(|occupancy| *occupancy > 0.0 && *occupancy <= 1.0));
        assert!(arrays.albedo.iter().all(|channel| (0.0..=1.0).contains(channel)));
        assert!(arrays.normal.rows().into_iter().all(|normal| normal.dot(&normal) < 1.02));
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let scenes = Scenes::new();
    let scene = scenes.bent_box();
    for name in ["out.npz", "out.ply"] {
        for source in ["moved", "exact"] {
            let write = || voxels(&scene, &scenes.path(name), &["--time", "0.7", "--source", source]);
            assert!(write() == write(), "{name}, {source}");
        }
    }
}

#[test]
fn what_is_not_moved_is_exact() {
    let scenes = Scenes::new();
    let scene = scenes.still_box();
    for options in [["--filter", "nearest", "--mode", "thin"], ["--filter", "split", "--mode", "conservative"]] {
        let cells = |source| {
            let options = options.into_iter().chain(["--source", source]).collect::<Vec<_>>();
            arrays(&voxels(&scene, &scenes.path("out.npz"), &options))
        };
        let (moved, exact) = (cells("moved"), cells("exact"));
        assert!(moved.cells == exact.cells && moved.occupancy == exact.occupancy, "{options:?}");
    }
}

#[test]
fn points_carry_the_same_cells() {
    let scenes = Scenes::new();
    let scene = scenes.turning_box();
    let count = arrays(&voxels(&scene, &scenes.path("out.npz"), &[])).cells.nrows();
    let ply = voxels(&scene, &scenes.path("out.ply"), &[]);
    let header = String::from_utf8_lossy(&ply[..ply.len().min(600)]).into_owned();
    assert!(header.starts_with("ply\nformat binary_little_endian 1.0\n"), "{header}");
    assert!(header.contains(&format!("element vertex {count}\n")), "{header}");
}

#[test]
fn made_scenes_are_the_built_in_ones() {
    let scenes = Scenes::new();
    let file = scenes.path("made.glb");
    let file_name = file.to_str().expect("UTF-8");
    for name in builtin::NAMES {
        let output = octolume(["make", name, "-o", file_name]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(Some(fs::read(&file).expect("a file").as_slice()), builtin::bytes(name), "{name}");
        let made = json(["info", file_name, "--json"]);
        let built_in = json(["info", name, "--json"]);
        assert_eq!((&made["triangles"], &made["levels"]), (&built_in["triangles"], &built_in["levels"]));
    }
}
