//! What a person may choose when a file is opened.

/// Choices of [`super::open_with`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenOptions {
    /// Which of the file's scenes is shown; `None`: the file's default scene, else its first.
    pub scene: Option<SceneChoice>,
    /// What opening may take: text, buffers, meshes, images. A file that needs more is refused
    /// before the memory is taken.
    pub memory_budget_bytes: u64,
}

/// One of the scenes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneChoice {
    /// From 0.
    Number(usize),
    /// By its name, or by its number where none has that name.
    Named(String),
}

impl SceneChoice {
    /// Which of the scenes of these names is meant.
    pub fn among(&self, names: &[String]) -> Option<usize> {
        let number = match self {
            Self::Number(number) => Some(*number),
            Self::Named(wanted) => names.iter().position(|name| name == wanted).or_else(|| wanted.parse().ok()),
        };
        number.filter(|&number| number < names.len())
    }
}

impl std::fmt::Display for SceneChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "number {number}"),
            Self::Named(name) => write!(f, "\"{name}\""),
        }
    }
}

impl Default for OpenOptions {
    fn default() -> Self {
        Self { scene: None, memory_budget_bytes: 4 << 30 }
    }
}
