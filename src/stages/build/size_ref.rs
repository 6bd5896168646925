//! Reference of `size.wgsl`: where the levels of an octree begin, counted through, and whether it has room.
//!
//! In: blocks of levels dense … depth−1, leaves, and what there is room for. Out: its sizes; without room those
//! of the same octree without blocks.

use crate::data::octree::OctreeParams;

pub fn size(blocks: &[u32], leaves: u32, room: &OctreeParams) -> OctreeParams {
    let depth = room.depth as usize;
    let sparse = room.dense_level as usize..depth;
    let has_room = sparse.clone().zip(blocks).all(|(level, &count)| count <= room.block_count_of(level as u32));
    if !has_room || leaves > room.leaf_count {
        return size(&vec![0; blocks.len()], 0, room);
    }
    let mut sized = OctreeParams::new(room.depth, room.dense_level);
    let (mut nodes, mut all_blocks) = (0, 0);
    for level in 0..depth {
        sized.levels[level].first_node = nodes;
        let is_dense = level <= sparse.start;
        nodes += if is_dense { 8_u32.pow(level as u32) } else { 8 * blocks[level - 1 - sparse.start] };
        if level >= sparse.start {
            sized.levels[level].first_block = all_blocks;
            all_blocks += blocks[level - sparse.start];
        }
    }
    sized.inner_node_count = nodes;
    sized.block_count = all_blocks;
    sized.leaf_block_count = blocks[blocks.len() - 1];
    sized.leaf_count = leaves;
    sized
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_octree_has_powers_of_eight() {
        let room = OctreeParams::new(4, 1).with_counts(&[0, 8, 72, 584], 4096);
        let full = size(&[8, 64, 512], 4096, &room);
        assert_eq!((full.inner_node_count, full.block_count, full.leaf_block_count), (585, 584, 512));
        assert_eq!([0, 1, 2, 3].map(|level| full.levels[level].first_node), [0, 1, 9, 73]);
        assert_eq!(full, room);
    }

    #[test]
    fn one_block_too_many_leaves_nothing() {
        let room = OctreeParams::new(4, 1).with_counts(&[0, 8, 72, 583], 4096);
        let none = size(&[8, 64, 512], 4096, &room);
        assert_eq!((none.inner_node_count, none.block_count, none.leaf_count), (9, 0, 0));
        assert_eq!((none.levels[2].first_node, none.levels[3].first_node, none.levels[3].first_block), (9, 9, 0));
    }
}
