//! Warnings of one kind: the first few in full, the rest counted. A file with a million defects
//! must not become a million sentences.

use crate::scene::Warning;
use crate::scene::load::error::counted;

const KEPT: usize = 8;

/// Sentences of one kind.
#[derive(Default)]
pub(in crate::scene::load) struct Few {
    kept: Vec<Warning>,
    more: usize,
}

impl Few {
    pub fn add(&mut self, warning: impl FnOnce() -> Warning) {
        match self.kept.len() < KEPT {
            true => self.kept.push(warning()),
            false => self.more += 1,
        }
    }

    pub fn append_to(self, warnings: &mut Vec<Warning>) {
        let last = self
            .kept
            .last()
            .map(|last| Warning::new(format!("{} more like \"{last}\"", counted(self.more, "defect", "defects"))));
        warnings.extend(self.kept);
        warnings.extend(last.filter(|_| self.more > 0));
    }
}
