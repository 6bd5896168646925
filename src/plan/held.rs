//! The keys of what is on the GPU.

use std::collections::BTreeMap;

use super::{FramePlan, Key, Part};

/// By part, the most recently used last.
#[derive(Clone, Debug, Default)]
pub struct Held(BTreeMap<Part, Vec<Key>>);

impl Held {
    /// Later ones count as used more recently.
    pub fn hold(&mut self, part: Part, key: Key) {
        self.0.entry(part).or_default().push(key);
    }

    /// All that a frame of this plan has made.
    pub fn hold_all(&mut self, plan: &FramePlan) {
        plan.to_run().iter().for_each(|planned| self.hold(planned.part, planned.key.clone()));
    }

    pub fn holds(&self, part: Part, key: &Key) -> bool {
        self.0.get(&part).is_some_and(|keys| keys.contains(key))
    }

    /// What a plan compares a new key with: the last one of its method, else the last one.
    pub(super) fn before(&self, part: Part, key: &Key) -> Option<&Key> {
        let keys = self.0.get(&part)?;
        keys.iter().rev().find(|before| before.method() == key.method()).or(keys.last())
    }
}
