//! Voxels kept on the disk: what they are found by, and how they are read and written.
//!
//! ```text
//! VoxelizeInput ──► ContentKey ──► FOLDER/<key in hex>.voxels ──► VoxelCache
//!              key                                        entry, fit
//! ```

mod entry;
mod fit;
mod key;

use std::io;

use crate::data::voxel_cache::VoxelCache;
use crate::disk_cache::{ContentKey, DiskCache};
use crate::stages::voxelize::VoxelizeInput;

pub use key::{ContentWriter, TextureHashes};

/// What a look into the folder finds.
#[derive(Clone, Debug, PartialEq)]
pub enum Kept {
    Found(VoxelCache),
    Missing,
    /// There is a file, but it cannot be read or is not what it should be.
    Damaged,
}

impl DiskCache {
    /// The voxels of `input`, if an entry of that key holds some that can be its.
    pub fn load(&self, key: &ContentKey, input: &VoxelizeInput) -> Kept {
        match self.read(&entry::KIND, key) {
            None => Kept::Missing,
            Some(bytes) => match entry::decode(&bytes, key).filter(|cache| fit::fits(cache, input)) {
                None => Kept::Damaged,
                Some(cache) => {
                    self.touch(&entry::KIND, key);
                    Kept::Found(cache)
                }
            },
        }
    }

    /// Keeps the voxels, in place of what was there. What is larger than the cap is not kept.
    pub fn store(&self, key: &ContentKey, cache: &VoxelCache) -> io::Result<()> {
        self.write_entry(&entry::KIND, key, &entry::encode(key, cache)?)
    }
}
