//! The keys of one method: of every part what it would be made from, or why nothing calls for it.

use super::{Key, Part};

/// A key, or why the part is skipped.
pub(super) type Wanted = Result<Key, &'static str>;

#[derive(Clone, Debug)]
pub struct Keys([Wanted; Part::ALL.len()]);

impl Default for Keys {
    fn default() -> Self {
        Self(std::array::from_fn(|_| Err("nothing is asked for")))
    }
}

impl Keys {
    pub(super) fn put(&mut self, part: Part, wanted: Wanted) {
        self.0[part as usize] = wanted;
    }

    pub fn get(&self, part: Part) -> Option<&Key> {
        self.0[part as usize].as_ref().ok()
    }

    pub(super) fn wanted(&self, part: Part) -> Result<&Key, &'static str> {
        self.0[part as usize].as_ref().map_err(|reason| *reason)
    }

    /// All that something calls for, in flow order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (Part, &Key)> {
        Part::ALL.into_iter().filter_map(|part| Some((part, self.get(part)?)))
    }
}
