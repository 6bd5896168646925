//! Reference of `place.wgsl`: voxels in block order.
//!
//! In: the block of every voxel and the blocks in key order. Out: each block's voxels as a set of
//! voxel numbers; the order inside a block is free.

use std::collections::BTreeSet;

use super::count_ref::Block;

pub fn place(voxel_blocks: &[Option<Block>], blocks_in_order: &[Block]) -> Vec<BTreeSet<usize>> {
    let members = |block: &Block| {
        let numbered = voxel_blocks.iter().enumerate();
        numbered.filter(|(_, of)| of.as_ref() == Some(block)).map(|(voxel, _)| voxel).collect()
    };
    blocks_in_order.iter().map(members).collect()
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
