//! Reference of `emit.wgsl`: nodes enumerated in (level, Morton key) order.
//!
//! In: the pyramids of `reduce_ref`. Out: block r of that order, its key, where its children begin
//! (`dense nodes + 8r`), which node above points there, and how many leaves a leaf block holds.

use std::collections::BTreeMap;

use super::reduce_ref::Pyramids;
use crate::data::grid::morton_key;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Emitted {
    /// Key of the node above each block, all levels in order.
    pub block_keys: Vec<u32>,
    /// Rank of the first block of levels dense … depth−1, then the number of blocks.
    pub first_blocks: Vec<u32>,
    /// Index of every inner node by level and coordinates.
    pub node_index: BTreeMap<(u32, [u32; 3]), u32>,
    /// A word an inner node, 0 without children.
    pub first_child: Vec<u32>,
    /// Occupied leaves of each leaf block.
    pub leaf_counts: Vec<u32>,
}

pub fn emit(pyramids: &Pyramids, dense_level: u32) -> Emitted {
    let depth = pyramids.allocated.len() as u32;
    let mut emitted = Emitted::default();
    for level in 0..=dense_level {
        let first = emitted.node_index.len() as u32;
        let nodes = super::reduce_ref::nodes(pyramids, dense_level, level);
        let index = |cell| ((level, cell), first + morton_key(cell));
        emitted.node_index.extend(nodes.into_iter().map(index));
    }
    let dense_nodes = emitted.node_index.len() as u32;
    emitted.first_child = vec![0; dense_nodes as usize];
    for level in dense_level..depth {
        emitted.first_blocks.push(emitted.block_keys.len() as u32);
        let mut blocks: Vec<_> = pyramids.allocated[level as usize].iter().copied().collect();
        blocks.sort_by_key(|cell| morton_key(*cell));
        for cell in blocks {
            emitted.push_block(pyramids, dense_nodes, level, cell);
        }
    }
    emitted.first_blocks.push(emitted.block_keys.len() as u32);
    emitted
}

impl Emitted {
    fn push_block(&mut self, pyramids: &Pyramids, dense_nodes: u32, level: u32, cell: [u32; 3]) {
        let depth = pyramids.allocated.len() as u32;
        let first = dense_nodes + 8 * self.block_keys.len() as u32;
        self.block_keys.push(morton_key(cell));
        let parent = self.node_index[&(level, cell)];
        self.first_child[parent as usize] = first;
        let children = (0..8).map(|corner| {
            let step = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
            [2 * cell[0] + step[0], 2 * cell[1] + step[1], 2 * cell[2] + step[2]]
        });
        if level + 1 == depth {
            let leaves = &pyramids.occupied[depth as usize];
            self.leaf_counts.push(children.filter(|child| leaves.contains(child)).count() as u32);
        } else {
            self.node_index.extend((first..).zip(children).map(|(index, child)| ((level + 1, child), index)));
            self.first_child.resize(first as usize + 8, 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::reduce_ref::{Cells, reduce};
    use super::*;

    #[test]
    fn a_leaf_in_the_corner_makes_one_block_a_level() {
        let emitted = emit(&reduce(&Cells::from([[0, 0, 0]]), 3, 1), 1);
        assert_eq!(emitted.first_blocks, [0, 1, 2]);
        assert_eq!(emitted.block_keys, [0, 0]);
        assert_eq!(emitted.leaf_counts, [1]);
        // Nodes: the root, 8 of level 1, 8 of level 2; leaves would begin behind them.
        assert_eq!(emitted.first_child.len(), 17);
        assert_eq!((emitted.first_child[1], emitted.first_child[9]), (9, 17));
    }
}
