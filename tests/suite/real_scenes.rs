//! The folder of real scenes beside the sources, which not every checkout has.

use std::io::Write;
use std::path::{Path, PathBuf};

/// Without the folder a test passes, and says past the capture of its output what it skipped.
pub fn real_scenes() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found =
        ["../shared/gltf", "../../shared/gltf"].map(|path| root.join(path)).into_iter().find(|path| path.is_dir());
    if found.is_none() {
        let thread = std::thread::current();
        let test = thread.name().unwrap_or("a test");
        writeln!(std::io::stderr(), "{test}: skipped what needs real scenes, there is no ../shared/gltf")
            .expect("stderr");
    }
    found
}
