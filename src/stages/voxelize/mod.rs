//! Pre-voxelization (section 3.1): triangles to cells, on the CPU, once per object.
//!
//! ```text
//! triangles ──► fragments (cell, triangle) ──► sorted by cell ──► voxels with payload
//!         coverage                    fragments            clip, surface, payload, joints
//! ```
//!
//! In: meshes whose positions are in cells of the cache's lattice. Out: a [`VoxelCache`], or the
//! covered cells alone. Results depend on the set of triangles only: not on their order, their
//! winding, the order of vertices or the number of threads.

mod clip;
mod coverage;
mod fragments;
mod joints;
mod payload;
mod plane;
mod pyramid;
mod surface;
mod triangle;

use glam::{DVec3, IVec3};
use rayon::prelude::*;

pub use coverage::CellBox;
pub use pyramid::TexturePyramids;

use crate::data::voxel_cache::{MAX_COORDINATE_CELLS, VoxelCache, VoxelizeReport};
use crate::progress::{Cancelled, Progress};
use crate::scene::{Material, Primitive, TextureRef};
use crate::settings::VoxelizationMode;
use fragments::{Fragments, MAX_EXTENT_CELLS, Soup};
use payload::MAX_FRAGMENTS;

/// Goes up with every change that gives any input another [`VoxelCache`]: caches kept on disk by
/// other versions are not read.
pub const ALGORITHM_VERSION: u32 = 2;

/// Geometry in lattice cells: the caller has applied stretch, span and phase.
pub struct VoxelizeInput<'a> {
    pub parts: Vec<VoxelizePart<'a>>,
    pub materials: &'a [Material],
    pub textures: &'a TexturePyramids,
    pub mode: VoxelizationMode,
    /// Give every voxel joints and weights.
    pub with_joints: bool,
}

/// A primitive, its positions in cells and its normals in cache space (any length), one a vertex.
pub struct VoxelizePart<'a> {
    pub primitive: &'a Primitive,
    pub positions_cells: Vec<DVec3>,
    pub normals: Vec<DVec3>,
}

/// Why an object has no voxels. Whoever knows file and object puts them in front.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum VoxelizeError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error("primitive {part}: vertex {vertex} is not finite or lies more than 2^30 cells from the lattice's origin")]
    Position { part: usize, vertex: usize },
    #[error("primitive {part}: {cause}")]
    Part { part: usize, cause: &'static str },
    #[error("it is {cells} cells long, and {limit} is the limit; choose a larger span")]
    TooLong { cells: i64, limit: i64 },
    #[error("it covers about {cells} cells, and {limit} is the limit; choose a larger span")]
    TooMany { cells: u64, limit: u64 },
}

impl<'a> VoxelizeInput<'a> {
    pub fn triangle_count(&self) -> u64 {
        self.parts.iter().map(|part| part.primitive.triangles.len() as u64).sum()
    }

    /// Units by which [`voxelize`] advances its progress; the caller announces them, so that a
    /// scene's total is known before its first object is done.
    pub fn work_units(&self) -> u64 {
        work_units(self.triangle_count())
    }

    /// Does a material in use give light? Then every voxel has an emission.
    pub fn emits(&self) -> bool {
        let default = Material::default();
        self.part_materials(&default).iter().any(|material| material.emissive != [0.0; 3])
    }

    /// The material of every part; validated by [`Self::check`].
    pub(crate) fn part_materials(&self, default: &'a Material) -> Vec<&'a Material> {
        let material = |part: &VoxelizePart| part.primitive.material.and_then(|index| self.materials.get(index));
        self.parts.iter().map(|part| material(part).unwrap_or(default)).collect()
    }

    /// Is every part whole, and is what it names there?
    pub(crate) fn check(&self) -> Result<(), VoxelizeError> {
        for (index, part) in self.parts.iter().enumerate() {
            let fault = |cause| Err(VoxelizeError::Part { part: index, cause });
            if part.normals.len() != part.positions_cells.len() {
                return fault("normals and positions differ in number");
            }
            let Some(material) = part.primitive.material else { continue };
            let Some(material) = self.materials.get(material) else { return fault("its material does not exist") };
            if !textures_read(material).iter().all(|&slot| self.textures.holds(slot)) {
                return fault("its material names a texture that is missing or empty");
            }
        }
        Ok(())
    }
}

/// The textures of a material that voxelization reads.
pub(crate) fn textures_read(material: &Material) -> [Option<TextureRef>; 3] {
    [material.base_color_texture, material.metallic_roughness_texture, material.emissive_texture]
}

/// [`VoxelizeInput::work_units`] of an object that is known by its size only.
pub fn work_units(triangles: u64) -> u64 {
    2 * triangles
}

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
        unweighted_vertices: if input.with_joints { input.parts.iter().map(unweighted).sum() } else { 0 },
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
