//! Where voxel caches came from.

use std::fmt;

/// How many caches came from where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheOrigins {
    pub voxelized: usize,
    /// Taken over from the preparation before.
    pub kept: usize,
    /// Read from the disk.
    pub read: usize,
    /// Of those voxelized, how many replace a damaged entry on the disk.
    pub replaced: usize,
}

/// "voxelized 0 objects, 398 read from the disk cache".
impl fmt::Display for CacheOrigins {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { voxelized, kept, read, replaced } = *self;
        write!(f, "voxelized {voxelized} object{}", if voxelized == 1 { "" } else { "s" })?;
        if replaced > 0 {
            write!(f, " ({replaced} in place of damaged entries)")?;
        }
        write!(f, ", {read} read from the disk cache")?;
        if kept > 0 { write!(f, ", {kept} kept") } else { Ok(()) }
    }
}
