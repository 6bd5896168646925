//! The folder as a whole: what it holds, how much it may hold, and what goes first.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use bytesize::GIB;
use serde::Serialize;

use super::DiskCache;

/// How much a folder holds at most, unless [`DiskCache::set_cap_bytes`] was asked for something else.
pub const DEFAULT_CAP_BYTES: u64 = 4 * GIB;
/// Holds the cap in decimal digits, so that every process obeys it.
const CAP_FILE: &str = "cap-bytes";
const UNFINISHED_EXTENSION: &str = "unfinished";
/// An unfinished file this old belongs to a process that was stopped.
const ABANDONED_AFTER: Duration = Duration::from_secs(3600);

/// Number and size of entries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Contents {
    pub entries: u64,
    pub bytes: u64,
}

struct Found {
    modified: SystemTime,
    path: PathBuf,
    bytes: u64,
}

impl DiskCache {
    pub fn contents(&self) -> io::Result<Contents> {
        Ok(total(&self.entries()?))
    }

    pub fn cap_bytes(&self) -> u64 {
        let cap = fs::read_to_string(self.folder.join(CAP_FILE)).ok();
        cap.and_then(|text| text.trim().parse().ok()).unwrap_or(DEFAULT_CAP_BYTES)
    }

    /// Sets the cap for good, and [trims](Self::trim).
    pub fn set_cap_bytes(&self, bytes: u64) -> io::Result<Contents> {
        self.write(&self.folder.join(CAP_FILE), |file| writeln!(file, "{bytes}"))?;
        self.trim()
    }

    /// Removes the least recently used entries until the rest is within the cap, and what stopped
    /// processes left behind. Returns what was removed.
    pub fn trim(&self) -> io::Result<Contents> {
        let is_abandoned = |file: &Found| file.modified.elapsed().is_ok_and(|age| age > ABANDONED_AFTER);
        remove(self.files(is_unfinished)?.iter().filter(|file| is_abandoned(file)))?;
        let mut entries = self.entries()?;
        entries.sort_by(|a, b| (a.modified, &a.path).cmp(&(b.modified, &b.path)));
        let mut excess = total(&entries).bytes.saturating_sub(self.cap_bytes());
        let surplus = entries.iter().take_while(|entry| {
            let goes = excess > 0;
            excess = excess.saturating_sub(entry.bytes);
            goes
        });
        remove(surplus)
    }

    /// Removes all entries, but not the cap. Returns what was removed.
    pub fn clear(&self) -> io::Result<Contents> {
        remove(&self.files(is_unfinished)?)?;
        remove(&self.entries()?)
    }

    /// A file that appears whole or not at all. A crash of the machine can leave it empty, which
    /// whoever reads it notices; waiting for the disk would cost more than it saves.
    pub(super) fn write(&self, path: &Path, content: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        let suffix = format!(".{UNFINISHED_EXTENSION}");
        let mut file = tempfile::Builder::new().suffix(&suffix).tempfile_in(&self.folder)?;
        content(file.as_file_mut())?;
        file.persist(path)?;
        Ok(())
    }

    fn entries(&self) -> io::Result<Vec<Found>> {
        self.files(is_entry)
    }

    /// Regular files of some names. A folder that does not exist holds none; a file that
    /// another process has just removed is not there.
    fn files(&self, is_one: fn(&Path) -> bool) -> io::Result<Vec<Found>> {
        let listing = match fs::read_dir(&self.folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            listing => listing?,
        };
        let mut files = Vec::new();
        for item in listing {
            let path = item?.path();
            let Ok(metadata) = fs::symlink_metadata(&path) else { continue };
            if metadata.is_file() && is_one(&path) {
                files.push(Found { modified: metadata.modified()?, path, bytes: metadata.len() });
            }
        }
        Ok(files)
    }
}

/// Entries of every kind are called by their key in hexadecimal.
fn is_entry(path: &Path) -> bool {
    let is_key = |stem: &str| stem.len() == 64 && stem.bytes().all(|digit| digit.is_ascii_hexdigit());
    path.extension().is_some() && path.file_stem().and_then(OsStr::to_str).is_some_and(is_key)
}

fn is_unfinished(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == UNFINISHED_EXTENSION)
}

fn total<'a>(files: impl IntoIterator<Item = &'a Found>) -> Contents {
    let add = |sum: Contents, file: &Found| Contents { entries: sum.entries + 1, bytes: sum.bytes + file.bytes };
    files.into_iter().fold(Contents::default(), add)
}

fn remove<'a>(files: impl IntoIterator<Item = &'a Found>) -> io::Result<Contents> {
    let mut removed = Vec::new();
    for file in files {
        match fs::remove_file(&file.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => removed.push(file),
        }
    }
    Ok(total(removed))
}
