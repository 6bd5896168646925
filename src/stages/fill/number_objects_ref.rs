//! Reference of `number_objects.wgsl`: the object that fills a leaf most.
//!
//! In: q and object of every voxel, a filter. Out, a leaf: the object of the largest weight that one
//! voxel puts there, weights compared in steps of 2^9; among equals the smallest number.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use crate::settings::Filter;
use crate::stages::build::mark_ref::{fragments, inside};

/// Bits of a weight that the comparison does not see.
pub const IGNORED_BITS: u32 = 9;

pub fn number(
    voxels: impl IntoIterator<Item = ([i64; 3], u32)>,
    depth: u32,
    filter: Filter,
) -> BTreeMap<[u32; 3], u32> {
    let mut largest = BTreeMap::new();
    for (q, object) in voxels {
        for (cell, weight) in fragments(q, filter) {
            let Some(cell) = inside(cell, depth) else { continue };
            let claim = (weight >> IGNORED_BITS, Reverse(object));
            let held = largest.entry(cell).or_insert(claim);
            *held = claim.max(*held);
        }
    }
    largest.into_iter().map(|(cell, (_, Reverse(object)))| (cell, object)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stages::transform::rigid_ref::ONE;

    #[test]
    fn most_weight_wins_and_the_smaller_number_a_tie() {
        let near = [ONE / 8, 0, 0];
        let far = [ONE / 2, 0, 0];
        let numbered = number([(far, 1), (near, 5), (near, 3)], 6, Filter::Split);
        assert_eq!(numbered, BTreeMap::from([([0, 0, 0], 3), ([1, 0, 0], 1)]));
    }
}
