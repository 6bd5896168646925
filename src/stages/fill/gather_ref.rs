//! Reference of `gather.wgsl`: what falls into each leaf, as exact 128-bit sums.
//!
//! In: world voxels (q, biased normal, albedo's code and coverage) and a filter. A weight is the share of the voxel's
//! cube in the cell, times the share of the cube that is covered. Out, a leaf with any weight w:
//! occupancy min(Σw, 2^3k), albedo Σw·a / Σw in units and normal Σw·n / Σw, both rounded half up, once;
//! stored is the code of these units ([`crate::data::albedo`]).

use std::collections::BTreeMap;

use crate::data::albedo;
use crate::data::octree::FULL_WEIGHT;
use crate::settings::Filter;
use crate::stages::build::mark_ref::{fragments, inside};

/// What gathering needs of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fragment {
    pub q: [i64; 3],
    /// 0 … 2·NORMAL_MAX a component.
    pub normal: [u32; 3],
    /// Codes: 0 … 255 a component.
    pub albedo: [u32; 3],
    /// How much of the voxel its surface covers, of 255: less where it is masked or blends.
    pub coverage: u32,
}

/// What counts of a weight, in 256ths rounded so that 255 is all of it, and nothing none of it.
pub fn covered(weight: u64, coverage: u32) -> u64 {
    let covered = u64::from(coverage + coverage / 128).max(1);
    weight - weight * (256 - covered) / 256
}

/// Unrounded, unclamped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeafSum {
    pub weight: u128,
    /// In units.
    pub albedo: [u128; 3],
    pub normal: [u128; 3],
}

/// Resolved: what is stored of an occupied leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leaf {
    pub occupancy: u32,
    /// Codes: 0 … 1020 a component.
    pub albedo: [u32; 3],
    pub normal: [u32; 3],
}

pub fn sums(voxels: impl IntoIterator<Item = Fragment>, depth: u32, filter: Filter) -> BTreeMap<[u32; 3], LeafSum> {
    let mut sums = BTreeMap::<_, LeafSum>::new();
    for voxel in voxels {
        for (cell, weight) in fragments(voxel.q, filter) {
            if let Some(cell) = inside(cell, depth) {
                sums.entry(cell).or_default().add(&voxel, u128::from(covered(weight, voxel.coverage)));
            }
        }
    }
    sums
}

impl LeafSum {
    pub fn add(&mut self, voxel: &Fragment, weight: u128) {
        self.weight += weight;
        for axis in 0..3 {
            self.albedo[axis] += weight * u128::from(albedo::units_of(voxel.albedo[axis]));
            self.normal[axis] += weight * u128::from(voxel.normal[axis]);
        }
    }

    /// Quantisation: division and clamping. Needs some weight.
    pub fn resolve(&self) -> Leaf {
        let mean = |sum: u128| ((2 * sum + self.weight) / (2 * self.weight)) as u32;
        Leaf {
            occupancy: self.weight.min(u128::from(FULL_WEIGHT)) as u32,
            albedo: self.albedo.map(|sum| albedo::code_of(mean(sum))),
            normal: self.normal.map(mean),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stages::transform::rigid_ref::ONE;

    #[test]
    fn a_quarter_and_three_quarters_mix_as_such() {
        let dark = Fragment { q: [ONE / 4, 0, 0], normal: [511, 511, 1022], albedo: [0, 0, 200], coverage: 255 };
        let light = Fragment { q: [3 * ONE / 4, 0, 0], normal: [511, 511, 0], albedo: [100, 3, 0], coverage: 255 };
        let sums = sums([dark, light], 6, Filter::Split);
        let leaf = sums[&[0, 0, 0]].resolve();
        assert_eq!(leaf.occupancy, FULL_WEIGHT);
        // Normal: (3·1022 + 0) / 4 = 766.5, which rounds up; albedo in units: 2500/4, 2/4, which rounds up too, 7500.
        assert_eq!((leaf.albedo, leaf.normal), ([200, 8, 693], [511, 511, 767]));
    }

    #[test]
    fn opposed_normals_have_zero_length() {
        let up = Fragment { q: [0; 3], normal: [511, 511, 1022], albedo: [9; 3], coverage: 255 };
        let down = Fragment { normal: [511, 511, 0], ..up };
        let leaf = sums([up, down], 6, Filter::Nearest)[&[0, 0, 0]].resolve();
        assert_eq!((leaf.normal, leaf.occupancy), ([511; 3], FULL_WEIGHT));
    }
}
