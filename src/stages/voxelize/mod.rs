//! Voxelization, two ways. Before everything else (section 3.1): triangles to cells, on the CPU, once per object. Or on
//! the GPU, every frame, of the posed triangles: what the paper compares its transformation with.
//!
//! ```text
//! triangles ──► fragments (cell, triangle) ──► sorted by cell ──► voxels with payload
//!         coverage                    fragments            clip, surface, payload, joints
//!
//! posed triangles ──► columns ──► fragments ──► the same, shaded ──► world voxels        every frame, on the GPU
//!               count        cover         shade             merge
//! ```
//!
//! In: meshes whose positions are in cells of the cache's lattice. Out: a [`VoxelCache`], or the
//! covered cells alone. Results depend on the set of triangles only: not on their order, their
//! winding, the order of vertices or the number of threads.

mod cell_store;
mod clip;
pub mod count;
pub mod count_ref;
pub mod cover;
pub mod cover_ref;
mod coverage;
mod fragments;
mod input;
mod joints;
mod materials;
pub mod merge;
pub mod merge_ref;
mod payload;
mod plane;
mod pyramid;
pub mod shade;
pub mod shade_ref;
mod surface;
mod triangle;

use glam::{DVec3, IVec3};
use rayon::prelude::*;

pub use cell_store::{CellStore, CellStoreBuffers};
pub use coverage::CellBox;
pub(crate) use input::textures_read;
pub use input::{VoxelizeError, VoxelizeInput, VoxelizePart, work_units};
pub use materials::SurfaceMaterials;
pub use pyramid::TexturePyramids;

use crate::data::voxel_cache::{MAX_COORDINATE_CELLS, VoxelCache, VoxelizeReport};
use crate::progress::Progress;
use crate::settings::VoxelizationMode;
use fragments::{Fragments, MAX_EXTENT_CELLS, Soup};
use payload::MAX_FRAGMENTS;

/// Goes up with every change that gives any input another [`VoxelCache`]: caches kept on disk by
/// other versions are not read.
pub const ALGORITHM_VERSION: u32 = 3;

/// Voxels of one object. Advances `progress` by [`VoxelizeInput::work_units`].
pub fn voxelize(input: &VoxelizeInput, progress: &Progress) -> Result<VoxelCache, VoxelizeError> {
    input.check()?;
    let soup = Soup::new(
        input.parts.iter().map(|part| (part.positions_cells.as_slice(), part.primitive.triangles.as_slice())),
    );
    let bounds = check_vertices(&soup)?;
    let clip = check_size(&soup, bounds)?;
    let chunks = fragments::scan(&soup, input.mode, clip, progress)?;
    let fragments = Fragments::sorted(chunks, clip[0]);
    if fragments.sorted.len() as u64 > MAX_FRAGMENTS {
        return Err(VoxelizeError::TooMany { cells: fragments.sorted.len() as u64, limit: MAX_FRAGMENTS });
    }
    let cache = payload::shade(input, &soup, &fragments, progress)?;
    let unweighted = |part: &VoxelizePart| joints::unweighted_vertices(part.primitive);
    let report = VoxelizeReport {
        triangles: input.triangle_count(),
        degenerate_triangles: fragments.degenerate_triangles,
        unweighted_vertices: if input.joints.is_some() { input.parts.iter().map(unweighted).sum() } else { 0 },
    };
    Ok(VoxelCache { report, ..cache })
}

/// The covered cells alone, each once, sorted by Morton key of the cell counted from `clip`'s lower
/// corner or, without `clip`, from the corner of the bounds. `clip` is half-open.
pub fn voxelize_cells(
    positions_cells: &[DVec3],
    triangles: &[[u32; 3]],
    mode: VoxelizationMode,
    clip: Option<CellBox>,
) -> Result<Vec<IVec3>, VoxelizeError> {
    let soup = Soup::new([(positions_cells, triangles)].into_iter());
    let bounds = check_vertices(&soup)?;
    let clip = match clip {
        Some(clip) => clip,
        None => check_size(&soup, bounds)?,
    };
    check_extent(clip)?;
    let chunks = fragments::scan(&soup, mode, clip, &Progress::default())?;
    Ok(fragments::sorted_cells(chunks, clip[0]))
}

/// Bounds of the positions, after a look at every vertex and index.
fn check_vertices(soup: &Soup) -> Result<[DVec3; 2], VoxelizeError> {
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for (index, part) in soup.parts.iter().enumerate() {
        // Written so that NaN fails it too.
        let usable = |position: &DVec3| position.abs().cmple(DVec3::splat(f64::from(MAX_COORDINATE_CELLS))).all();
        if let Some(vertex) = part.positions.iter().position(|position| !usable(position)) {
            return Err(VoxelizeError::Position { part: index, vertex });
        }
        let count = part.positions.len();
        if part.triangles.par_iter().any(|triangle| triangle.iter().any(|&vertex| vertex as usize >= count)) {
            return Err(VoxelizeError::Part { part: index, cause: "a triangle names a vertex that does not exist" });
        }
        bounds = part.positions.iter().fold(bounds, |[min, max], &p| [min.min(p), max.max(p)]);
    }
    Ok(bounds)
}

/// A box of cells around everything, after a look at its extent and at the number of cells it may hold.
fn check_size(soup: &Soup, bounds: [DVec3; 2]) -> Result<CellBox, VoxelizeError> {
    if bounds[0].x > bounds[1].x {
        return Ok([IVec3::ZERO; 2]);
    }
    let all = [bounds[0].floor().as_ivec3(), bounds[1].floor().as_ivec3() + 1];
    check_extent(all)?;
    let cells = |part: &fragments::SoupPart| -> f64 {
        let corner = |vertex: u32| part.positions[vertex as usize];
        let area = |&[a, b, c]: &[u32; 3]| 0.5 * (corner(b) - corner(a)).cross(corner(c) - corner(a)).length();
        part.triangles.iter().map(area).sum()
    };
    let cells = soup.parts.iter().map(cells).sum::<f64>() as u64;
    // A triangle covers at most √3 cells for each unit of area, and some along its border.
    if cells > MAX_FRAGMENTS / 4 {
        return Err(VoxelizeError::TooMany { cells, limit: MAX_FRAGMENTS / 4 });
    }
    Ok(all)
}

fn check_extent([min, max]: CellBox) -> Result<(), VoxelizeError> {
    let cells = (max.as_i64vec3() - min.as_i64vec3()).max_element();
    if cells > MAX_EXTENT_CELLS { Err(VoxelizeError::TooLong { cells, limit: MAX_EXTENT_CELLS }) } else { Ok(()) }
}
