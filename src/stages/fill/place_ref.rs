//! Reference of `place.wgsl`: voxels in block order.
//!
//! In: the block of every voxel and the blocks in key order. Out: each block's voxels as a set of
//! voxel numbers; the order inside a block is free.

use std::collections::{BTreeMap, BTreeSet};

use super::count_ref::Block;

pub fn place(voxel_blocks: &[Option<Block>], blocks_in_order: &[Block]) -> Vec<BTreeSet<usize>> {
    let mut members: BTreeMap<Block, BTreeSet<usize>> = BTreeMap::new();
    for (voxel, block) in voxel_blocks.iter().enumerate() {
        if let Some(block) = block {
            members.entry(*block).or_default().insert(voxel);
        }
    }
    blocks_in_order.iter().map(|block| members.remove(block).unwrap_or_default()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_voxel_is_with_its_block_and_an_outsider_nowhere() {
        let (a, b) = ([0, 0, 0], [1, 0, 0]);
        let placed = place(&[Some(b), None, Some(a), Some(b)], &[a, b]);
        assert_eq!(placed, [BTreeSet::from([2]), BTreeSet::from([0, 3])]);
    }
}
