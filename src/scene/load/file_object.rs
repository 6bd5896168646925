//! An object of the file as messages name it: `mesh 3 "wheel", primitive 0`.

use std::fmt;

use crate::scene::{FilePart, Warning};

/// The lists of a file, and what one of their items is called.
const KINDS: [(&str, &str); 14] = [
    ("accessors", "accessor"),
    ("animations", "animation"),
    ("buffers", "buffer"),
    ("bufferViews", "buffer view"),
    ("cameras", "camera"),
    ("images", "image"),
    ("lights", "light"),
    ("materials", "material"),
    ("meshes", "mesh"),
    ("nodes", "node"),
    ("samplers", "sampler"),
    ("scenes", "scene"),
    ("skins", "skin"),
    ("textures", "texture"),
];

/// What one item of a list is called, where glTF knows the list.
pub fn kind_of(list: &str) -> Option<&'static str> {
    KINDS.iter().find_map(|&(known, kind)| (known == list).then_some(kind))
}

#[derive(Clone, Debug)]
pub struct FileObject {
    name: String,
    part: Option<FilePart>,
}

impl FileObject {
    /// `mesh 3 "wheel"`.
    pub fn item(kind: &'static str, index: usize, name: Option<&str>) -> Self {
        Self { name: label(kind, index, name), part: Some(FilePart { kind, index }) }
    }

    /// What is no item of a list.
    pub fn other(name: impl Into<String>) -> Self {
        Self { name: name.into(), part: None }
    }

    /// Something in it: `mesh 3 "wheel", primitive 0`.
    pub fn member(&self, member: impl fmt::Display) -> Self {
        Self { name: format!("{}, {member}", self.name), part: self.part }
    }

    pub fn part(&self) -> Option<FilePart> {
        self.part
    }

    pub fn warning(&self, cause: impl fmt::Display) -> Warning {
        Warning { sentence: format!("{}: {cause}", self.name), part: self.part, nodes: Vec::new() }
    }
}

impl fmt::Display for FileObject {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.name)
    }
}

impl From<FileObject> for String {
    fn from(object: FileObject) -> Self {
        object.name
    }
}

/// `mesh 3 "wheel"`.
pub fn label(kind: &str, index: usize, name: Option<&str>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} \"{name}\""),
        _ => format!("{kind} {index}"),
    }
}
