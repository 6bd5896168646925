//! What an object is voxelized from, and why it is not.

use glam::DVec3;

use super::pyramid::TexturePyramids;
use crate::progress::Cancelled;
use crate::scene::{Material, Primitive, TextureRef};
use crate::settings::{JointWeights, VoxelizationMode};

/// Geometry in lattice cells: the caller has applied stretch, span and phase.
pub struct VoxelizeInput<'a> {
    pub parts: Vec<VoxelizePart<'a>>,
    pub materials: &'a [Material],
    pub textures: &'a TexturePyramids,
    pub mode: VoxelizationMode,
    /// How voxels get joints and weights, if they do.
    pub joints: Option<JointWeights>,
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

    /// Units by which [`super::voxelize`] advances its progress; the caller announces them, so that a
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
