//! Reference of `count.wgsl`: which leaf block (2³ cells) sorts a voxel, and how many each sorts.
//!
//! In: q of every voxel, `None` where it misses the grid. The base block is that of the cell which
//! holds most of the voxel's lower corner: the base cell under split, the only cell under nearest.
//! A base in the guard layer sorts with the first cell of the grid along that axis.

use std::collections::BTreeMap;

use crate::settings::Filter;
use crate::stages::build::mark_ref::inside;
use crate::stages::transform::rigid_ref::ONE;

/// Coordinates of a leaf block: cells halved.
pub type Block = [u32; 3];

pub fn block_of(q: [i64; 3], depth: u32, filter: Filter) -> Option<Block> {
    let cell = match filter {
        Filter::Split => q.map(|lower| lower.div_euclid(ONE).max(0)),
        Filter::Nearest => q.map(|lower| (lower + ONE / 2).div_euclid(ONE)),
    };
    inside(cell, depth).map(|cell| cell.map(|c| c / 2))
}

pub fn count(voxels: impl IntoIterator<Item = Option<[i64; 3]>>, depth: u32, filter: Filter) -> BTreeMap<Block, u64> {
    let mut counts = BTreeMap::new();
    for block in voxels.into_iter().filter_map(|q| block_of(q?, depth, filter)) {
        *counts.entry(block).or_default() += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guard_layer_and_far_edge() {
        let below = [-ONE / 2, 2 * ONE, 0];
        assert_eq!(block_of(below, 6, Filter::Split), Some([0, 1, 0]));
        assert_eq!(block_of(below, 6, Filter::Nearest), Some([0, 1, 0]));
        assert_eq!(block_of([-ONE / 2 - 1, 0, 0], 6, Filter::Nearest), None);
        assert_eq!(block_of([64 * ONE - 1, 0, 0], 6, Filter::Split), Some([31, 0, 0]));
        assert_eq!(block_of([64 * ONE - 1, 0, 0], 6, Filter::Nearest), None);
    }
}
