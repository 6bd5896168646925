//! Pictures and voxels as files. The same content always gives the same bytes.

mod light_file;
mod picture;
mod voxel_file;

use std::path::{Path, PathBuf};

pub use light_file::write_exr;
pub use picture::{png_bytes, read_settings, write_png};
pub use voxel_file::{write_npz, write_ply};

/// One sentence naming file and cause.
#[derive(Debug, thiserror::Error)]
#[error("{}: {cause}", file.display())]
pub struct ExportError {
    pub file: PathBuf,
    pub cause: String,
}

impl ExportError {
    fn new(file: &Path, cause: impl ToString) -> Self {
        Self { file: file.to_owned(), cause: cause.to_string() }
    }
}

/// Writes a whole file at once, so that what fails on the way leaves no half of one.
fn write_file(file: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    std::fs::write(file, bytes).map_err(|error| ExportError::new(file, error))
}
