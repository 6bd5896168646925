//! Reference of `link.wgsl`: forward axial neighbours by coordinates (section 4.4), not by keys.
//!
//! In: the blocks of every sparse level in rank order, as the coordinates of the node above each.
//! Out: for each block the ranks of the blocks one cell further along x, y, z; `None` where there is
//! none. For nodes the same, with index `dense nodes + 8 · rank + child`.

use std::collections::BTreeMap;

use crate::data::grid::{morton_cell, morton_key};

/// A block: level and coordinates of the node above it.
pub type Block = (u32, [u32; 3]);

pub fn link_blocks(blocks: &[Block]) -> Vec<[Option<u32>; 3]> {
    let rank: BTreeMap<Block, u32> = blocks.iter().copied().zip(0..).collect();
    let ahead = |(level, cell): Block| [0, 1, 2].map(|axis| rank.get(&(level, forward(cell, axis))).copied());
    blocks.iter().copied().map(ahead).collect()
}

/// The eight nodes of each block in turn.
pub fn link_nodes(blocks: &[Block], dense_node_count: u32) -> Vec<[Option<u32>; 3]> {
    let children = |(level, cell): Block| (0..8).map(move |i| (level + 1, morton_cell(8 * morton_key(cell) + i)));
    let nodes: Vec<Block> = blocks.iter().copied().flat_map(children).collect();
    let index: BTreeMap<Block, u32> = nodes.iter().copied().zip(dense_node_count..).collect();
    let ahead = |(level, cell): Block| [0, 1, 2].map(|axis| index.get(&(level, forward(cell, axis))).copied());
    nodes.iter().copied().map(ahead).collect()
}

fn forward(mut cell: [u32; 3], axis: usize) -> [u32; 3] {
    cell[axis] += 1;
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_blocks_in_a_row() {
        let blocks = [(1, [0, 1, 1]), (1, [1, 1, 1])];
        assert_eq!(link_blocks(&blocks), [[Some(1), None, None], [None; 3]]);
        let nodes = link_nodes(&blocks, 9);
        // Child 0 sees its siblings, child 1 the next block's child 0 along x.
        assert_eq!(nodes[0], [Some(10), Some(11), Some(13)]);
        assert_eq!(nodes[1], [Some(17), Some(12), Some(14)]);
        assert_eq!(nodes[15], [None; 3]);
    }
}
