//! Reference of `gather_heavy.wgsl`: which leaf blocks are too heavy for one thread.
//!
//! What a heavy block holds is `gather_ref`'s sums, there without a bound already. In: voxels a
//! block sorts. Out: the blocks that more than MAX_FRAGMENTS voxels can reach: their own and, under
//! split, those of the blocks behind them.

use std::collections::{BTreeMap, BTreeSet};

use super::count_ref::Block;
use crate::data::octree::MAX_FRAGMENTS;
use crate::settings::Filter;

pub fn heavy(counts: &BTreeMap<Block, u64>, leaf_blocks: &BTreeSet<Block>, filter: Filter) -> BTreeSet<Block> {
    let is_heavy = |block: &&Block| {
        let behind = |corner: u32| {
            let [x, y, z] = **block;
            Some([x.checked_sub(corner & 1)?, y.checked_sub(corner >> 1 & 1)?, z.checked_sub(corner >> 2 & 1)?])
        };
        let sources = if filter == Filter::Split { 0..8 } else { 0..1 };
        let reaching: u64 = sources.filter_map(behind).filter_map(|block| counts.get(&block)).sum();
        reaching > u64::from(MAX_FRAGMENTS)
    };
    leaf_blocks.iter().filter(is_heavy).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crowd_makes_its_block_and_the_blocks_ahead_heavy() {
        let counts = BTreeMap::from([([1, 1, 1], u64::from(MAX_FRAGMENTS) + 1)]);
        let blocks = BTreeSet::from([[0, 1, 1], [1, 1, 1], [2, 1, 1], [2, 2, 2], [3, 1, 1]]);
        let split = heavy(&counts, &blocks, Filter::Split);
        assert_eq!(split, BTreeSet::from([[1, 1, 1], [2, 1, 1], [2, 2, 2]]));
        assert_eq!(heavy(&counts, &blocks, Filter::Nearest), BTreeSet::from([[1, 1, 1]]));
    }
}
