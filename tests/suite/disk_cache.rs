//! Voxels kept on disk: what a second opening finds, whole or not at all, whoever else is at it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use octolume::disk_cache::DiskCache;
use octolume::prepare::{CacheOrigins, PrepareError, Prepared, Stores, prepare, prepare_with};
use octolume::progress::Progress;
use octolume::scene::{Scene, builtin, load};
use octolume::settings::VoxelizationMode;
use octolume::settings::{Discretization, Discretizer, Filter, JointWeights, Stretching, VoxelAnchor, VoxelizerCells};
use tempfile::TempDir;

use crate::real_scenes::real_scenes;
use crate::scenes::cube_scene;

/// A cache in a folder that goes away with the test.
pub struct Folder {
    pub disk: DiskCache,
    pub folder: TempDir,
}

impl Folder {
    pub fn new() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        Self { disk: DiskCache::at(folder.path().join("voxels")), folder }
    }

    pub fn entries(&self) -> BTreeSet<PathBuf> {
        let items = fs::read_dir(self.disk.folder()).expect("the folder exists");
        items.map(|item| item.expect("an item").path()).collect()
    }
}

pub fn small(scene: &str) -> Arc<Scene> {
    let bytes = builtin::bytes(scene).expect("a built-in scene");
    Arc::new(load::open_bytes(scene, bytes, None, &Progress::default()).unwrap_or_else(|error| panic!("{error}")))
}

pub fn through(disk: &DiskCache, scene: &Arc<Scene>, discretization: &Discretization) -> Prepared {
    let stores = Stores { disk: Some(disk), ..Stores::default() };
    prepare_with(Arc::clone(scene), discretization, stores, &Progress::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

pub const SMALL: Discretization = Discretization {
    grid: 64,
    span: None,
    mode: VoxelizationMode::Thin,
    weights: JointWeights::Interpolated,
    filter: Filter::Split,
    dense_level: Some(5),
    anchor: VoxelAnchor::Centre,
    discretizer: Discretizer::Transform,
    stretching: Stretching::Voxelize,
    cells: VoxelizerCells::Sparse,
};

pub fn assert_same_voxels(found: &Prepared, expected: &Prepared) {
    assert_eq!(found.caches.len(), expected.caches.len());
    for (found, expected) in found.caches.iter().zip(&expected.caches) {
        // Bits, so that −0 and 0 differ.
        assert!(found == expected && bytes(&found.emission) == bytes(&expected.emission));
    }
    assert_eq!(found.voxel_count(), expected.voxel_count());
}

fn bytes(emission: &[[f32; 3]]) -> &[u8] {
    bytemuck::cast_slice(emission)
}

#[test]
fn a_second_preparation_voxelizes_nothing() {
    let (folder, scene) = (Folder::new(), small("courtyard"));
    let plain = prepare(Arc::clone(&scene), &SMALL, None, &Progress::default()).expect("prepares");
    let count = plain.caches.len();
    assert_eq!(plain.origins, CacheOrigins { voxelized: count, ..CacheOrigins::default() });
    let first = through(&folder.disk, &scene, &SMALL);
    assert_eq!(first.origins, plain.origins);
    // Opened anew: nothing is shared with the first but the folder.
    let second = through(&folder.disk, &small("courtyard"), &SMALL);
    assert_eq!(second.origins, CacheOrigins { read: count, ..CacheOrigins::default() });
    assert_eq!(second.origins.to_string(), format!("voxelized 0 objects, {count} read from the disk cache"));
    for prepared in [&first, &second] {
        assert_same_voxels(prepared, &plain);
        assert_eq!(prepared.warnings, plain.warnings);
    }
    // What is at hand is not read again; another span is other content.
    let stores = Stores { reuse: Some(&second), disk: Some(&folder.disk), ..Stores::default() };
    let third = prepare_with(Arc::clone(&second.scene), &SMALL, stores, &Progress::default()).expect("prepares");
    assert_eq!(third.origins, CacheOrigins { kept: count, ..CacheOrigins::default() });
    let finer = Discretization { span: Some(0.9 * plain.grid.span), ..SMALL };
    assert_eq!(through(&folder.disk, &scene, &finer).origins, plain.origins);
}

#[test]
fn objects_of_equal_content_share_an_entry() {
    let folder = Folder::new();
    let scene = |name: &str| {
        let mut scene = cube_scene(Default::default());
        (scene.name, scene.meshes[0].name) = (name.to_owned(), name.to_owned());
        Arc::new(scene)
    };
    assert_eq!(through(&folder.disk, &scene("one"), &SMALL).origins.voxelized, 1);
    assert_eq!(through(&folder.disk, &scene("two"), &SMALL).origins.read, 1);
    assert_eq!(folder.entries().len(), 1);
}

/// Does something to an entry that is known to be good.
type Damage = fn(&Path, &[u8]);

#[test]
fn damaged_entries_are_replaced() {
    let (folder, scene) = (Folder::new(), Arc::new(cube_scene(Default::default())));
    let expected = through(&folder.disk, &scene, &SMALL);
    let entry = folder.entries().pop_first().expect("an entry");
    let good = fs::read(&entry).expect("readable");
    let damages: [(&str, Damage); 6] = [
        ("empty", |entry, _| fs::write(entry, []).expect("written")),
        ("truncated", |entry, good| fs::write(entry, &good[..good.len() - 1]).expect("written")),
        ("longer", |entry, good| fs::write(entry, [good, &[0]].concat()).expect("written")),
        ("flipped", |entry, good| {
            let mut bytes = good.to_vec();
            bytes[good.len() / 2] ^= 16;
            fs::write(entry, bytes).expect("written");
        }),
        ("something else", |entry, _| fs::write(entry, vec![7; 1 << 16]).expect("written")),
        ("good", |entry, good| fs::write(entry, good).expect("written")),
    ];
    for (damage, inflict) in damages {
        inflict(&entry, &good);
        let replaced = usize::from(damage != "good");
        let prepared = through(&folder.disk, &scene, &SMALL);
        assert_eq!((prepared.origins.replaced, prepared.origins.read), (replaced, 1 - replaced), "{damage}");
        assert_same_voxels(&prepared, &expected);
        assert_eq!((fs::read(&entry).expect("readable"), prepared.warnings.len()), (good.clone(), 0), "{damage}");
    }
    // Another object's entry under this name: its hash is right, but it is not this one's.
    through(&folder.disk, &scene, &Discretization { grid: 128, ..SMALL });
    let other = folder.entries().into_iter().find(|path| *path != entry).expect("another entry");
    fs::copy(&other, &entry).expect("copied");
    assert_eq!(through(&folder.disk, &scene, &SMALL).origins.replaced, 1);
}

#[test]
fn cancelling_leaves_whole_entries_or_none() {
    let (folder, scene) = (Folder::new(), small("courtyard"));
    let cancelled_at = |fraction: f32| {
        let progress = Progress::default();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while progress.fraction() < fraction {
                    std::thread::yield_now();
                }
                progress.cancel();
            });
            let stores = Stores { disk: Some(&folder.disk), ..Stores::default() };
            let result = prepare_with(Arc::clone(&scene), &SMALL, stores, &progress);
            // Too late to cancel is no failure.
            progress.cancel();
            assert!(matches!(result, Err(PrepareError::Cancelled(_)) | Ok(_)));
        });
    };
    for percent in [0, 10, 30, 60, 90] {
        cancelled_at(percent as f32 / 100.0);
        let unfinished = |path: &PathBuf| path.extension().is_some_and(|extension| extension != "voxels");
        assert!(!folder.disk.folder().exists() || !folder.entries().iter().any(unfinished));
    }
    let after = through(&folder.disk, &scene, &SMALL);
    assert_eq!(after.origins.replaced, 0);
    assert_same_voxels(&after, &prepare(scene, &SMALL, None, &Progress::default()).expect("prepares"));
}

#[test]
fn threads_share_a_folder() {
    let (folder, scene) = (Folder::new(), small("courtyard"));
    let expected = prepare(Arc::clone(&scene), &SMALL, None, &Progress::default()).expect("prepares");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let prepared = through(&folder.disk, &scene, &SMALL);
                assert_same_voxels(&prepared, &expected);
                assert_eq!(prepared.origins.replaced, 0);
                folder.disk.trim().expect("trimmed");
            });
        }
        // One that clears while the others read and write.
        scope.spawn(|| (0..20).for_each(|_| _ = folder.disk.clear().expect("cleared")));
    });
    through(&folder.disk, &scene, &SMALL);
    assert_eq!(through(&folder.disk, &scene, &SMALL).origins.voxelized, 0);
}

#[test]
fn the_second_opening_of_sponza_voxelizes_nothing() {
    let Some(path) = real_scenes().map(|folder| folder.join("Sponza/Sponza_objects.gltf")) else { return };
    let open = || Arc::new(load::open(&path, &Progress::default()).unwrap_or_else(|error| panic!("{error}")));
    let (folder, scene) = (Folder::new(), open());
    let first = through(&folder.disk, &scene, &SMALL);
    let second = through(&folder.disk, &open(), &SMALL);
    let count = first.caches.len();
    assert!(count > 300, "{count}");
    assert_eq!(second.origins, CacheOrigins { read: count, ..CacheOrigins::default() });
    assert_same_voxels(&second, &first);
}
