//! What can go wrong when a file is opened, each as one sentence.

use crate::progress::Cancelled;

/// Why a file could not be opened; its text names file, object and cause.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    #[error("{file}: {cause}")]
    Unreadable { file: String, cause: String },
    #[error("{file}: {object}: {cause}")]
    Invalid { file: String, object: String, cause: String },
    #[error("{file}: opening was cancelled")]
    Cancelled { file: String },
}

/// A [`LoadError`] before the file's name is known.
#[derive(Debug)]
pub(in crate::scene::load) enum Defect {
    Invalid { object: String, cause: String },
    Cancelled,
}

impl Defect {
    pub fn new(object: impl Into<String>, cause: impl Into<String>) -> Self {
        Self::Invalid { object: object.into(), cause: cause.into() }
    }

    pub fn in_file(self, file: &str) -> LoadError {
        let file = file.to_owned();
        match self {
            Self::Invalid { object, cause } => LoadError::Invalid { file, object, cause: one_line(&cause) },
            Self::Cancelled => LoadError::Cancelled { file },
        }
    }
}

impl From<Cancelled> for Defect {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Turns a bare cause into a [`Defect`] of the object it is about.
pub(super) trait About<T> {
    fn about<N: Into<String>>(self, object: impl FnOnce() -> N) -> Result<T, Defect>;
}

impl<T> About<T> for Result<T, String> {
    fn about<N: Into<String>>(self, object: impl FnOnce() -> N) -> Result<T, Defect> {
        self.map_err(|cause| Defect::new(object(), cause))
    }
}

/// Texts of other libraries may have several lines; a sentence has one.
pub(in crate::scene::load) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `1 vertex`, `3 vertices`.
pub(in crate::scene::load) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
