//! What is kept between runs, by the content it was made from: voxels of objects, so that a scene that was opened before
//! voxelizes nothing (section 3.1 is done once per object, not once per opening), pictures of the path tracer, which go
//! on from there. This is the folder; what is kept knows how.
//!
//! ```text
//! what the work reads ──► ContentKey ──► FOLDER/<key in hex>.<kind> ──► what it made
//! ```
//!
//! A key is made from the content that the work reads and from nothing else, so entries are
//! never out of date; they only go unused, and the least recently used go first. Files appear by
//! renaming, whole or not at all, and everything read is checked: processes and threads share the
//! folder without locks, and a damaged entry is the same as none.

mod content_key;
mod folder;
mod seal;

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use directories::ProjectDirs;

pub use content_key::ContentKey;
pub use folder::{Contents, DEFAULT_CAP_BYTES};
pub use seal::{Kind, Sealed, open, take};

/// Names the folder of the cache; empty: no cache.
pub const FOLDER_VARIABLE: &str = "OCTOLUME_CACHE_DIR";

/// A folder of entries. Holds nothing open; as many as wanted may be on one folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiskCache {
    folder: PathBuf,
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

    /// Keeps an entry, in place of what was there. What is larger than the cap is not kept.
    pub fn write_entry(&self, kind: &Kind, key: &ContentKey, entry: &Sealed) -> io::Result<()> {
        if entry.bytes() > self.cap_bytes() {
            return Ok(());
        }
        self.write(&self.path(kind, key), |file| entry.write(file))
    }

    /// The bytes of an entry, none of a file that cannot be one; `None` where there is no file.
    pub fn read(&self, kind: &Kind, key: &ContentKey) -> Option<Vec<u8>> {
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

    /// Says that an entry was used. The age only decides what goes first, and a folder may be readable but not writable.
    pub fn touch(&self, kind: &Kind, key: &ContentKey) {
        let file = File::options().append(true).open(self.path(kind, key));
        let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
    }

    fn path(&self, kind: &Kind, key: &ContentKey) -> PathBuf {
        self.folder.join(key.to_string()).with_extension(kind.extension)
    }
}
