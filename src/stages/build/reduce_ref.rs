//! Reference of `reduce.wgsl`: the two pyramids as sets of node coordinates (section 4.4's dummies).
//!
//! In: the occupied leaves, level `depth`. Out, a set a level:
//!
//! ```text
//! O(l) = parents of O(l+1)                                               something is below
//! A(l) = parents of A(l+1) ∪ parents of backward-dilate(O(l+1))          children are allocated
//! ```
//!
//! Backward-dilate adds the eight neighbours at {0, −1}³ that lie in the grid. A exists for levels
//! dense … depth−1; every node of a level up to the dense one exists anyway.

use std::collections::BTreeSet;

pub type Cells = BTreeSet<[u32; 3]>;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pyramids {
    /// O of levels 0 … depth.
    pub occupied: Vec<Cells>,
    /// A of levels 0 … depth−1, empty above the dense level.
    pub allocated: Vec<Cells>,
}

pub fn parents(cells: &Cells) -> Cells {
    cells.iter().map(|cell| cell.map(|c| c / 2)).collect()
}

pub fn backward_dilate(cells: &Cells) -> Cells {
    let backward = |cell: &[u32; 3]| {
        let cell = *cell;
        (0..8).filter_map(move |corner| {
            let [x, y, z] = cell;
            Some([x.checked_sub(corner & 1)?, y.checked_sub(corner >> 1 & 1)?, z.checked_sub(corner >> 2 & 1)?])
        })
    };
    cells.iter().flat_map(backward).collect()
}

pub fn reduce(leaves: &Cells, depth: u32, dense_level: u32) -> Pyramids {
    let mut occupied = vec![leaves.clone()];
    let mut allocated = vec![Cells::new()];
    for level in (0..depth).rev() {
        let (below, allocated_below) = (&occupied[occupied.len() - 1], &allocated[allocated.len() - 1]);
        let mut blocks = Cells::new();
        if level >= dense_level {
            blocks = parents(allocated_below);
            blocks.extend(parents(&backward_dilate(below)));
        }
        let above = parents(below);
        occupied.push(above);
        allocated.push(blocks);
    }
    occupied.reverse();
    allocated.reverse();
    allocated.pop();
    Pyramids { occupied, allocated }
}

/// Nodes stored at a level: all of a dense one, else the children of A one level up. Level `depth`
/// are the leaves of allocated blocks.
pub fn nodes(pyramids: &Pyramids, dense_level: u32, level: u32) -> Cells {
    let child = |cell: &[u32; 3], corner: u32| {
        [2 * cell[0] + (corner & 1), 2 * cell[1] + (corner >> 1 & 1), 2 * cell[2] + (corner >> 2 & 1)]
    };
    if level <= dense_level {
        let n = 1 << level;
        return (0..n * n * n).map(|i| [i % n, i / n % n, i / (n * n)]).collect();
    }
    let blocks = &pyramids.allocated[level as usize - 1];
    blocks.iter().flat_map(|cell| (0..8).map(move |corner| child(cell, corner))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leaf_asks_for_the_dummies_of_intermediate_levels() {
        // Leaf 5 → node 2 of level 2, whose interpolation needs node 1 of that level.
        let pyramids = reduce(&Cells::from([[5, 5, 5]]), 3, 0);
        assert_eq!(pyramids.occupied[2], Cells::from([[2, 2, 2]]));
        assert_eq!(pyramids.allocated[2], Cells::from([[2, 2, 2]]));
        assert_eq!(pyramids.allocated[1].len(), 8);
        assert!(pyramids.allocated[1].contains(&[0, 0, 0]) && pyramids.allocated[1].contains(&[1, 1, 1]));
        assert_eq!(pyramids.allocated[0], Cells::from([[0, 0, 0]]));
    }

    #[test]
    fn dummies_do_not_breed_and_stay_in_the_grid() {
        let pyramids = reduce(&Cells::from([[0, 0, 0]]), 3, 0);
        for level in 0..3 {
            assert_eq!(pyramids.allocated[level], Cells::from([[0, 0, 0]]));
        }
        // Leaf 4 has its dummies in leaf block 1, whose own backward neighbour 0 nobody needs.
        let pyramids = reduce(&Cells::from([[4, 0, 0]]), 3, 0);
        assert_eq!(pyramids.allocated[2], Cells::from([[1, 0, 0], [2, 0, 0]]));
    }
}
