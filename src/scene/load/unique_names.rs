//! Names by which a person can choose.

use std::collections::HashSet;

/// Tells apart what has one name: the second is called `name (2)`.
#[derive(Default)]
pub(super) struct UniqueNames(HashSet<String>);

impl UniqueNames {
    pub(super) fn of(&mut self, name: String) -> String {
        let numbered = (2..).map(|number| format!("{name} ({number})"));
        let unique = std::iter::once(name.clone()).chain(numbered).find(|name| !self.0.contains(name));
        let unique = unique.unwrap_or(name);
        self.0.insert(unique.clone());
        unique
    }
}
