//! Reference of `ghost`: which of three colours a leaf has, by set membership.

use std::collections::BTreeSet;

use glam::{DVec3, IVec3};

use super::GhostColors;
use super::march_ref::DrawnCell;

/// What the cell shows; `None` where neither set has it.
pub fn shown(
    cell: IVec3,
    moved: &BTreeSet<[i32; 3]>,
    exact: &BTreeSet<[i32; 3]>,
    colors: &GhostColors,
) -> Option<DrawnCell> {
    let cell = cell.to_array();
    let color = match (moved.contains(&cell), exact.contains(&cell)) {
        (true, true) => colors.both,
        (false, true) => colors.holes,
        (true, false) => colors.spill,
        (false, false) => return None,
    };
    let [r, g, b, a] = color.map(f64::from);
    Some(DrawnCell { occupancy: a, color: DVec3::new(r, g, b), normal: DVec3::ZERO, shaded: true })
}
