//! Reference of `gather_emission.wgsl`: mean emission of each leaf, Σw·e / Σw, from exact sums.

use std::collections::BTreeMap;

use crate::settings::Filter;
use crate::stages::build::mark_ref::{fragments, inside};
use crate::stages::fill::gather_ref::covered;

/// `voxels`: q in 2^-8 cells, coverage of 255, and emission in units of the brightest over EMISSION_MAX. Out: 0 … that
/// maximum, of every leaf that any voxel reaches.
pub fn gather_emission(
    voxels: impl IntoIterator<Item = ([i64; 3], u32, [u32; 3])>,
    depth: u32,
    filter: Filter,
) -> BTreeMap<[u32; 3], [f64; 3]> {
    let mut sums = BTreeMap::<_, (u128, [u128; 3])>::new();
    for (q, coverage, emission) in voxels {
        for (cell, weight) in fragments(q, filter) {
            let Some(cell) = inside(cell, depth) else { continue };
            let weight = covered(weight, coverage);
            let (total, sum) = sums.entry(cell).or_default();
            *total += u128::from(weight);
            for (channel, value) in sum.iter_mut().zip(emission) {
                *channel += u128::from(weight) * u128::from(value);
            }
        }
    }
    sums.into_iter().map(|(cell, (total, sum))| (cell, sum.map(|sum| sum as f64 / total as f64))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stages::transform::rigid_ref::ONE;

    #[test]
    fn a_dark_voxel_dims_a_bright_one_by_its_share() {
        let voxels = [([ONE / 4, 0, 0], 255, [8, 0, 0]), ([3 * ONE / 4, 0, 0], 255, [0, 0, 4])];
        let leaves = gather_emission(voxels, 6, Filter::Split);
        assert_eq!(leaves[&[0, 0, 0]], [6.0, 0.0, 1.0]);
        assert_eq!(leaves[&[1, 0, 0]], [2.0, 0.0, 3.0]);
    }
}
