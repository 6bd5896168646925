//! What a person may choose when a file is opened.

/// Choices of [`super::open_with`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenOptions {
    /// Which of the file's scenes is shown, by its name or its number from 0; `None`: the file's
    /// default scene, else its first.
    pub scene: Option<String>,
    /// What opening may take: text, buffers, meshes, images. A file that needs more is refused
    /// before the memory is taken.
    pub memory_budget_bytes: u64,
}

impl Default for OpenOptions {
    fn default() -> Self {
        Self { scene: None, memory_budget_bytes: 4 << 30 }
    }
}
