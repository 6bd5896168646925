//! The folder of the disk cache: what it may hold, what goes first, and one that takes nothing.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use octolume::disk_cache::{Contents, DEFAULT_CAP_BYTES, DiskCache};
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::settings::Discretization;

use crate::disk_cache::{Folder, SMALL, assert_same_voxels, small, through};
use crate::scenes::cube_scene;

#[test]
fn a_folder_that_takes_nothing_is_one_warning_and_everything_goes_on() {
    let (folder, scene) = (Folder::new(), small("courtyard"));
    let file = folder.folder.path().join("file");
    File::create(&file).expect("created");
    let disk = DiskCache::at(file.join("voxels"));
    let plain = prepare(Arc::clone(&scene), &SMALL, None, &Progress::default()).expect("prepares");
    let prepared = through(&disk, &scene, &SMALL);
    assert_same_voxels(&prepared, &plain);
    let [known @ .., warning] = prepared.warnings.as_slice() else { panic!("a warning is missing") };
    assert_eq!(known, plain.warnings);
    let start = format!("voxels are not kept for the next opening: {} cannot be written (", disk.folder().display());
    assert!(warning.sentence.starts_with(&start) && warning.sentence.ends_with(')'), "{warning}");
    assert_eq!((disk.contents().ok(), disk.cap_bytes()), (None, DEFAULT_CAP_BYTES));
}

/// Lets every entry seem last used that many hours ago.
fn age(entry: &Path, hours: u64) {
    let then = SystemTime::now() - Duration::from_secs(3600 * hours);
    File::options().append(true).open(entry).and_then(|file| file.set_modified(then)).expect("aged");
}

#[test]
fn the_least_recently_used_entries_go_first_and_reading_is_using() {
    let (folder, scene) = (Folder::new(), Arc::new(cube_scene(Default::default())));
    let spans = [0.25, 0.125, 0.0625];
    let at = |span| Discretization { span: Some(span), ..SMALL };
    let mut entries = Vec::new();
    for span in spans {
        let before = if entries.is_empty() { BTreeSet::new() } else { folder.entries() };
        through(&folder.disk, &scene, &at(span));
        entries.extend(folder.entries().difference(&before).cloned());
    }
    let sizes: Vec<u64> = entries.iter().map(|entry| entry.metadata().expect("there").len()).collect();
    let all = Contents { entries: 3, bytes: sizes.iter().sum() };
    assert_eq!(folder.disk.contents().expect("listed"), all);
    for (entry, hours) in entries.iter().zip([9, 8, 7]) {
        age(entry, hours);
    }
    assert_eq!(through(&folder.disk, &scene, &at(spans[0])).origins.read, 1);
    // One byte too many: the second is now the oldest.
    let removed = folder.disk.set_cap_bytes(all.bytes - 1).expect("trimmed");
    assert_eq!(removed, Contents { entries: 1, bytes: sizes[1] });
    let exists: Vec<bool> = entries.iter().map(|entry| entry.exists()).collect();
    assert_eq!(exists, [true, false, true]);
    // A cap holds for whoever comes next, and what comes new pushes out what is old.
    let again = DiskCache::at(folder.disk.folder());
    assert_eq!(again.cap_bytes(), all.bytes - 1);
    assert_eq!(through(&again, &scene, &at(spans[1])).origins.voxelized, 1);
    assert_eq!(entries.iter().map(|entry| entry.exists()).collect::<Vec<_>>(), [true, true, false]);
    // What is larger than the cap is not kept, and pushes nothing out.
    let smallest = *sizes.iter().min().expect("three");
    assert_eq!(smallest, sizes[0]);
    again.set_cap_bytes(smallest).expect("trimmed");
    assert_eq!(through(&again, &scene, &at(spans[2])).origins.voxelized, 1);
    assert_eq!(again.contents().expect("listed"), Contents { entries: 0, bytes: 0 });
    assert_eq!(through(&again, &scene, &at(spans[0])).origins.voxelized, 1);
    assert_eq!(again.contents().expect("listed"), Contents { entries: 1, bytes: smallest });
}

#[test]
fn clearing_leaves_the_cap_and_what_is_not_the_caches() {
    let (folder, scene) = (Folder::new(), Arc::new(cube_scene(Default::default())));
    assert_eq!(folder.disk.contents().expect("an absent folder is empty"), Contents::default());
    through(&folder.disk, &scene, &SMALL);
    folder.disk.set_cap_bytes(12_345_678).expect("trimmed");
    let [foreign, abandoned, fresh] =
        ["notes.txt", "a.unfinished", "b.unfinished"].map(|name| folder.disk.folder().join(name));
    for file in [&foreign, &abandoned, &fresh] {
        fs::write(file, "text").expect("written");
    }
    age(&abandoned, 2);
    assert_eq!(folder.disk.trim().expect("trimmed"), Contents::default());
    assert!(!abandoned.exists() && fresh.exists());
    assert_eq!(folder.disk.clear().expect("cleared").entries, 1);
    assert_eq!((folder.entries().len(), foreign.exists(), fresh.exists()), (2, true, false));
    assert_eq!((folder.disk.cap_bytes(), folder.disk.contents().expect("listed")), (12_345_678, Contents::default()));
    // A cap that cannot be read is the usual one.
    fs::write(folder.disk.folder().join("cap-bytes"), "much").expect("written");
    assert_eq!(folder.disk.cap_bytes(), DEFAULT_CAP_BYTES);
}
