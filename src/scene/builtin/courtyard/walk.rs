//! The clip `walk`, in which all that moves has tracks.

use super::super::glb::ClipWriter;

pub const WALK_SECS: f64 = 10.0;

pub fn clip() -> ClipWriter {
    ClipWriter::new("walk")
}
