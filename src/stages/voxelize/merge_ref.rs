//! Reference of merging: sums by cell and object in integers that never overflow, one division each.

use std::collections::BTreeMap;

use glam::DVec3;

use super::shade_ref::Shaded;
use crate::data::albedo::{ALBEDO_CODE_ONE, pack_color};
use crate::data::fragments::visible;
use crate::data::packing::{NORMAL_MAX, pack_normal};

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    area: u128,
    weight: u128,
    color: [u128; 3],
    normal: [u128; 3],
}

/// Normal and albedo words of a voxel.
pub type Words = [u32; 2];

/// By Morton key and object. A cell without visible area has no voxel.
pub fn merge(fragments: impl IntoIterator<Item = (u32, u32, Shaded)>) -> BTreeMap<(u32, u32), Words> {
    let mut sums: BTreeMap<(u32, u32), Sums> = BTreeMap::new();
    for (key, object, shaded) in fragments {
        let sum = sums.entry((key, object)).or_default();
        let weight = u128::from(visible(shaded.area, shaded.opacity));
        sum.area += u128::from(shaded.area);
        sum.weight += weight;
        for axis in 0..3 {
            sum.color[axis] += weight * u128::from(shaded.roots[axis]).pow(2);
            sum.normal[axis] += weight * u128::from(shaded.normal >> (10 * axis) & 0x3ff);
        }
    }
    sums.into_iter().filter(|(_, sum)| sum.weight > 0).map(|(of, sum)| (of, sum.words())).collect()
}

impl Sums {
    fn words(&self) -> Words {
        let mean = |sum: u128| sum as f64 / self.weight as f64;
        let [r, g, b] = self.color.map(|sum| mean(sum) / f64::from(ALBEDO_CODE_ONE).powi(2));
        let normal = DVec3::from_array(self.normal.map(|sum| mean(sum) / f64::from(NORMAL_MAX) - 1.0));
        let cancelled = normal.length() * f64::from(NORMAL_MAX) < 1.0;
        let coverage = self.weight as f64 / self.area as f64;
        [pack_normal(if cancelled { DVec3::ZERO } else { normal }), pack_color([r, g, b, coverage])]
    }
}
