//! Reference of `mark.wgsl`: filtering (section 3.3) as exact sets and sums.
//!
//! In: q of every voxel in 2^-k cells, `None` for one that misses the grid. Out: the leaves with any
//! weight, and the weight outside the grid in 2^-3k voxels; kept + clipped = 2^3k a voxel.

use std::collections::BTreeSet;

use crate::data::octree::FULL_WEIGHT;
use crate::settings::Filter;
use crate::stages::transform::rigid_ref::ONE;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Marked {
    pub leaves: BTreeSet<[u32; 3]>,
    pub kept: u128,
    pub clipped: u128,
}

/// Cells a voxel falls into and its weight there, weights above zero only.
///
/// Split: the volume that a unit cube with lower corner `q` shares with each of the eight cells
/// around it. Nearest: all of it in the cell that its centre lies in.
pub fn fragments(q: [i64; 3], filter: Filter) -> Vec<([i64; 3], u64)> {
    if filter == Filter::Nearest {
        return vec![(q.map(|lower| (lower + ONE / 2).div_euclid(ONE)), u64::from(FULL_WEIGHT))];
    }
    let base = q.map(|lower| lower.div_euclid(ONE));
    let overlap = |axis: usize, step: i64| {
        let cell = (base[axis] + step) * ONE;
        (cell + ONE).min(q[axis] + ONE) - cell.max(q[axis])
    };
    let steps = (0..8).map(|corner| [corner & 1, corner >> 1 & 1, corner >> 2 & 1]);
    let corner = |step: [i64; 3]| {
        let weight: i64 = (0..3).map(|axis| overlap(axis, step[axis])).product();
        ([base[0] + step[0], base[1] + step[1], base[2] + step[2]], weight as u64)
    };
    steps.map(corner).filter(|(_, weight)| *weight > 0).collect()
}

/// A cell of the grid as such, `None` outside.
pub fn inside(cell: [i64; 3], depth: u32) -> Option<[u32; 3]> {
    cell.iter().all(|&c| (0..1 << depth).contains(&c)).then(|| cell.map(|c| c as u32))
}

pub fn mark(voxels: impl IntoIterator<Item = Option<[i64; 3]>>, depth: u32, filter: Filter) -> Marked {
    let mut marked = Marked::default();
    for voxel in voxels {
        let Some(q) = voxel else {
            marked.clipped += u128::from(FULL_WEIGHT);
            continue;
        };
        for (cell, weight) in fragments(q, filter) {
            match inside(cell, depth) {
                Some(cell) => {
                    marked.leaves.insert(cell);
                    marked.kept += u128::from(weight);
                }
                None => marked.clipped += u128::from(weight),
            }
        }
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_voxel_half_a_cell_off_along_x_gives_each_side_half() {
        let half = u64::from(FULL_WEIGHT) / 2;
        let found = fragments([ONE + ONE / 2, 0, -ONE], Filter::Split);
        assert_eq!(found, [([1, 0, -1], half), ([2, 0, -1], half)]);
        assert_eq!(fragments([ONE + ONE / 2, 0, 0], Filter::Nearest), [([2, 0, 0], 2 * half)]);
        assert_eq!(fragments([ONE + ONE / 2 - 1, 0, 0], Filter::Nearest), [([1, 0, 0], 2 * half)]);
    }

    #[test]
    fn a_voxel_that_sticks_out_by_a_corner_loses_that_corner() {
        let marked = mark([Some([-ONE / 2; 3]), None], 6, Filter::Split);
        assert_eq!(marked.leaves, BTreeSet::from([[0, 0, 0]]));
        assert_eq!((marked.kept, marked.clipped), (1 << 21, (1 << 24) - (1 << 21) + (1 << 24)));
    }
}
