//! `octolume cache`: what is kept on disk from one opening to the next, and clearing it.

use std::io;
use std::path::PathBuf;

use anyhow::Context;
use bytesize::ByteSize;
use clap::{Args, ValueEnum};
use octolume::disk_cache::{Contents, DiskCache, FOLDER_VARIABLE};
use serde::Serialize;

use super::output;

/// Says where voxels of objects and traced pictures are kept from one opening to the next and how many; clears
/// them
#[derive(Debug, Args)]
pub struct Cache {
    /// What to do with them; otherwise nothing
    action: Option<Action>,
    /// Holds no more than this from now on, such as 512MiB; the least recently used go first. At first 4GiB
    #[arg(long, value_name = "SIZE")]
    cap: Option<ByteSize>,
    /// Prints JSON
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Action {
    /// Removes all of them
    Clear,
}

#[derive(Serialize)]
struct Facts {
    folder: PathBuf,
    #[serde(flatten)]
    contents: Contents,
    cap_bytes: u64,
    /// By this command.
    removed: Contents,
}

impl Cache {
    pub fn run(&self) -> anyhow::Result<()> {
        let cache = DiskCache::standard().with_context(|| {
            format!("there is no disk cache: {FOLDER_VARIABLE} is empty, or this system has no place for one")
        })?;
        let facts = self.act(&cache).with_context(|| cache.folder().display().to_string())?;
        if self.json { output::json(&facts) } else { output::result(&facts.text()) }
    }

    fn act(&self, cache: &DiskCache) -> io::Result<Facts> {
        let mut removed = Contents::default();
        if let Some(cap) = self.cap {
            removed = cache.set_cap_bytes(cap.as_u64())?;
        }
        if let Some(Action::Clear) = self.action {
            let cleared = cache.clear()?;
            removed.entries += cleared.entries;
            removed.bytes += cleared.bytes;
        }
        let folder = cache.folder().to_owned();
        Ok(Facts { folder, contents: cache.contents()?, cap_bytes: cache.cap_bytes(), removed })
    }
}

impl Facts {
    fn text(&self) -> String {
        let Self { folder, contents, cap_bytes, removed } = self;
        let mut lines = vec![
            folder.display().to_string(),
            format!("{}, {} at most", counted(contents), ByteSize(*cap_bytes).display().iec()),
        ];
        if removed.entries > 0 {
            lines.push(format!("removed {}", counted(removed)));
        }
        lines.join("\n")
    }
}

/// "2 entries, 1.5 MiB".
fn counted(contents: &Contents) -> String {
    let Contents { entries, bytes } = *contents;
    format!("{entries} entr{}, {}", if entries == 1 { "y" } else { "ies" }, ByteSize(bytes).display().iec())
}
