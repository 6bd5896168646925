//! Voxel caches kept on disk, so that a scene that was opened before voxelizes nothing (section 3.1
//! is done once per object, not once per opening); and pictures of the path tracer, which go on from there.
//!
//! ```text
//! VoxelizeInput ──► ContentKey ──► FOLDER/<key in hex>.voxels ──► VoxelCache
//!              key             folder                       entry
//! traced scene  ──► ContentKey ──► FOLDER/<key in hex>.film   ──► Film
//! ```
//!
//! A key is made from the content that the work reads and from nothing else, so entries are
//! never out of date; they only go unused, and the least recently used go first. Files appear by
//! renaming, whole or not at all, and everything read is checked: processes and threads share the
//! folder without locks, and a damaged entry is the same as none.

mod entry;
mod film;
mod fit;
mod folder;
mod key;
mod seal;

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use directories::ProjectDirs;

use crate::accuracy::path_tracer::Film;
use crate::data::voxel_cache::VoxelCache;
use crate::stages::voxelize::VoxelizeInput;

pub use folder::{Contents, DEFAULT_CAP_BYTES};
pub use key::{ContentKey, TextureHashes, Writer};
use seal::{Kind, Sealed};

const KINDS: [Kind; 2] = [entry::KIND, film::KIND];

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
        match self.read(&entry::KIND, key) {
            None => Lookup::Missing,
            Some(bytes) => match entry::decode(&bytes, key).filter(|cache| fit::fits(cache, input)) {
                None => Lookup::Damaged,
                Some(cache) => {
                    self.touch(&entry::KIND, key);
                    Lookup::Found(cache)
                }
            },
        }
    }

    /// Keeps the voxels, in place of what was there. What is larger than the cap is not kept.
    pub fn store(&self, key: &ContentKey, cache: &VoxelCache) -> io::Result<()> {
        self.write_entry(&entry::KIND, key, &entry::encode(key, cache)?)
    }

    /// The picture of that key with no more than `most_samples` a pixel; `None` where there is none, or it is
    /// damaged.
    pub fn load_film(&self, key: &ContentKey, size_px: [u32; 2], most_samples: u32) -> Option<Film> {
        let bytes = self.read(&film::KIND, key)?;
        let film = film::decode(&bytes, key, size_px)?;
        self.touch(&film::KIND, key);
        (film.samples() <= most_samples).then_some(film)
    }

    /// Keeps a picture whose pixels all have as many samples; of several, the one with most is kept.
    pub fn store_film(&self, key: &ContentKey, film: &Film) -> io::Result<()> {
        let kept = self.load_film(key, film.size_px(), u32::MAX);
        if kept.is_some_and(|kept| kept.samples() >= film.samples()) {
            return Ok(());
        }
        self.write_entry(&film::KIND, key, &film::encode(key, film)?)
    }

    fn write_entry(&self, kind: &Kind, key: &ContentKey, entry: &Sealed) -> io::Result<()> {
        if entry.len() > self.cap_bytes() {
            return Ok(());
        }
        self.write(&self.path(kind, key), |file| entry.write(file))
    }

    /// The bytes of an entry, none of a file that cannot be one; `None` where there is no file.
    fn read(&self, kind: &Kind, key: &ContentKey) -> Option<Vec<u8>> {
        let path = self.path(kind, key);
        match fs::metadata(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            // What is no file might never end, and what is larger than the cap was never stored.
            Ok(metadata) if metadata.is_file() && metadata.len() <= self.cap_bytes() => {
                Some(fs::read(&path).unwrap_or_default())
            }
            _ => Some(Vec::new()),
        }
    }

    /// The age only decides what goes first, and a folder may be readable but not writable.
    fn touch(&self, kind: &Kind, key: &ContentKey) {
        let file = File::options().append(true).open(self.path(kind, key));
        let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
    }

    fn path(&self, kind: &Kind, key: &ContentKey) -> PathBuf {
        self.folder.join(key.to_string()).with_extension(kind.extension)
    }
}
