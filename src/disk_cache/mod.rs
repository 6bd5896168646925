//! Voxel caches kept on disk, so that a scene that was opened before voxelizes nothing (section 3.1
//! is done once per object, not once per opening).
//!
//! ```text
//! VoxelizeInput ──► ContentKey ──► FOLDER/<key in hex>.voxels ──► VoxelCache
//!              key             folder                       entry
//! ```
//!
//! A key is made from the content that voxelization reads and from nothing else, so entries are
//! never out of date; they only go unused, and the least recently used go first. Files appear by
//! renaming, whole or not at all, and everything read is checked: processes and threads share the
//! folder without locks, and a damaged entry is the same as none.

mod entry;
mod fit;
mod folder;
mod key;

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use directories::ProjectDirs;

use crate::data::voxel_cache::VoxelCache;
use crate::stages::voxelize::VoxelizeInput;

pub use folder::{Contents, DEFAULT_CAP_BYTES};
pub use key::{ContentKey, TextureHashes};

/// Names the folder of the cache; empty: no cache.
pub const FOLDER_VARIABLE: &str = "OCTOLUME_CACHE_DIR";

/// A folder of entries. Holds nothing open; as many as wanted may be on one folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiskCache {
    folder: PathBuf,
}

/// What a look into the folder finds.
#[derive(Clone, Debug, PartialEq)]
pub enum Lookup {
    Found(VoxelCache),
    Missing,
    /// There is a file, but it cannot be read or is not what it should be.
    Damaged,
}

impl DiskCache {
    /// The folder need not exist; it is made when something is stored.
    pub fn at(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// In the folder that [`FOLDER_VARIABLE`] names, else in the platform's place for caches. `None`
    /// where the variable is empty or the platform knows no such place.
    pub fn standard() -> Option<Self> {
        match std::env::var_os(FOLDER_VARIABLE) {
            Some(folder) => (!folder.is_empty()).then(|| Self::at(folder)),
            None => ProjectDirs::from("", "", "octolume").map(|folders| Self::at(folders.cache_dir().join("voxels"))),
        }
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The voxels of `input`, if an entry of that key holds some that can be its.
    pub fn load(&self, key: &ContentKey, input: &VoxelizeInput) -> Lookup {
        let path = self.path(key);
        let bytes = match fs::metadata(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Lookup::Missing,
            // What is no file might never end, and what is larger than the cap was never stored.
            Ok(metadata) if metadata.is_file() && metadata.len() <= self.cap_bytes() => fs::read(&path).ok(),
            _ => None,
        };
        let Some(bytes) = bytes else { return Lookup::Damaged };
        let Some(cache) = entry::decode(&bytes, key).filter(|cache| fit::fits(cache, input)) else {
            return Lookup::Damaged;
        };
        // The age only decides what goes first, and a folder may be readable but not writable.
        let _ = File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Lookup::Found(cache)
    }

    /// Keeps the voxels, in place of what was there. What is larger than the cap is not kept.
    pub fn store(&self, key: &ContentKey, cache: &VoxelCache) -> io::Result<()> {
        let entry = entry::Encoded::new(key, cache)?;
        if entry.len() > self.cap_bytes() {
            return Ok(());
        }
        self.write(&self.path(key), |file| entry.write(file))
    }

    fn path(&self, key: &ContentKey) -> PathBuf {
        self.folder.join(key.to_string()).with_extension(folder::ENTRY_EXTENSION)
    }
}
