//! What was repaired, left out or approximated: a sentence for people, and what it is about for programs.

use std::fmt;

#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Warning {
    pub sentence: String,
    /// What of the file it names; `None` for the file as a whole, and for what is found later.
    pub part: Option<FilePart>,
    /// The nodes of [`super::Scene::nodes`] it is about, ascending: the part itself, or those that show, carry or
    /// follow it.
    pub nodes: Vec<usize>,
}

/// An item of one of the lists of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FilePart {
    /// `node`, `mesh`, `skin`, `material`, …
    pub kind: &'static str,
    /// In the file's order.
    pub index: usize,
}

impl Warning {
    /// About nothing in particular.
    pub fn new(sentence: impl Into<String>) -> Self {
        Self { sentence: sentence.into(), ..Self::default() }
    }

    pub fn at(self, node: usize) -> Self {
        Self { nodes: vec![node], ..self }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.sentence)
    }
}

impl PartialEq<&str> for Warning {
    fn eq(&self, sentence: &&str) -> bool {
        self.sentence == *sentence
    }
}

impl PartialEq<String> for Warning {
    fn eq(&self, sentence: &String) -> bool {
        self.sentence == *sentence
    }
}
