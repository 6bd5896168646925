//! The world grid: N³ cubic cells of edge δ (the paper's *span*), N = 2^depth.

use glam::{DMat4, DVec3, IVec3};
use serde::{Deserialize, Serialize};

/// `corner = anchor + offset_cells · δ`: the lattice hangs on the scene's own anchor, never on
/// world zero, so that a scene far away loses no precision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    pub anchor: DVec3,
    pub offset_cells: IVec3,
    /// δ, scene units.
    pub span: f64,
    /// Octree depth: N = 2^depth.
    pub depth: u32,
}

impl Grid {
    /// N, cells along an axis.
    pub fn cells(&self) -> u32 {
        1 << self.depth
    }

    pub fn corner(&self) -> DVec3 {
        self.anchor + self.offset_cells.as_dvec3() * self.span
    }

    /// Position in cells from the anchor. Voxelization works there and shifts whole cells after, so
    /// that geometry on a cell plane falls to the same side whatever the grid's corner.
    pub fn cells_from_anchor(&self, world: DVec3) -> DVec3 {
        (world - self.anchor) / self.span
    }

    /// Eq. 2 as a matrix: world position to cell coordinates.
    pub fn grid_from_world(&self) -> DMat4 {
        // Anchor first: it is close to the scene, so the subtraction cancels nothing that matters.
        DMat4::from_translation(-self.offset_cells.as_dvec3())
            * DMat4::from_scale(DVec3::splat(1.0 / self.span))
            * DMat4::from_translation(-self.anchor)
    }
}

/// Morton key of a cell: bit 3i of the key is bit i of x, then y, then z. Up to 10 bits an axis.
pub fn morton_key(cell: [u32; 3]) -> u32 {
    spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2
}

pub fn morton_cell(key: u32) -> [u32; 3] {
    [compact(key), compact(key >> 1), compact(key >> 2)]
}

fn spread(value: u32) -> u32 {
    let mut v = value & 0x3ff;
    v = (v | v << 16) & 0x0300_00ff;
    v = (v | v << 8) & 0x0300_f00f;
    v = (v | v << 4) & 0x030c_30c3;
    (v | v << 2) & 0x0924_9249
}

fn compact(key: u32) -> u32 {
    let mut v = key & 0x0924_9249;
    v = (v | v >> 2) & 0x030c_30c3;
    v = (v | v >> 4) & 0x0300_f00f;
    v = (v | v >> 8) & 0x0300_00ff;
    (v | v >> 16) & 0x3ff
}
