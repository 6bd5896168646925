//! Reference of `compare_sets`: set differences by their definition.

use std::collections::BTreeSet;

/// |exact ∖ moved|, |moved ∖ exact|, |moved ∩ exact|.
pub fn holes_spill_both(moved: &BTreeSet<u32>, exact: &BTreeSet<u32>) -> [u64; 3] {
    [
        exact.difference(moved).count() as u64,
        moved.difference(exact).count() as u64,
        moved.intersection(exact).count() as u64,
    ]
}
