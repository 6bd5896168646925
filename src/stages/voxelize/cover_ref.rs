//! Reference of covering: the exact predicates of the caches' voxelization, and the pieces it cuts.

use glam::{DVec3, IVec3};

use super::clip::Clipper;
use super::coverage::{CellBox, for_each_cell};
use super::triangle::Triangle;
use crate::settings::VoxelizationMode;

/// What a triangle leaves in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    pub cell: IVec3,
    /// Cells².
    pub area: f64,
    /// Share of the triangle's area.
    pub share: f64,
    /// The triangle's corners' weights at the middle.
    pub weights: DVec3,
}

/// Every cell of `clip` that a triangle covers.
pub fn cover(corners: [DVec3; 3], mode: VoxelizationMode, clip: CellBox) -> Vec<Covered> {
    let Some(triangle) = Triangle::new(&corners, [0, 1, 2]) else { return Vec::new() };
    let clipper = Clipper::new(&triangle);
    let mut covered = Vec::new();
    for_each_cell(&triangle, mode, clip, |cell| {
        let piece = clipper.piece(cell);
        let mut weights = DVec3::ZERO;
        (0..3).for_each(|corner| weights[triangle.vertices[corner] as usize] = piece.centroid[corner]);
        covered.push(Covered { cell, area: piece.area, share: piece.area / clipper.area, weights });
    });
    covered
}
