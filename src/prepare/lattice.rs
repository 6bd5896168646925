//! Lattices (section 4.2, Eq. 1). A cache's origin is an integer multiple of δ in its own space. Static objects lie
//! on the grid's own lattice and reproduce exactly.

use glam::{DMat3, DMat4, DVec3, Vec3};

use crate::data::grid::Grid;
use crate::scene::geometry::normal_matrix;

/// Where an object's cache lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lattice {
    /// The grid's own, counted from its anchor, with the rest pose baked in: a static object.
    Grid { grid: Grid, world_from_mesh: DMat4 },
    /// The object's: stretch baked in, origin at zero of the space that node or joints move. What is flat always is.
    Own { cells_from_mesh: DMat4, space_from_cells: DMat4, is_flat: bool },
}

impl Lattice {
    /// What voxelization is given.
    pub fn cells_from_mesh(&self, position: DVec3) -> DVec3 {
        match self {
            Self::Grid { grid, world_from_mesh } => grid.cells_from_anchor(world_from_mesh.transform_point3(position)),
            Self::Own { cells_from_mesh, .. } => cells_from_mesh.transform_point3(position),
        }
    }

    /// Lattice cells to the world at rest, or to the space that node or joints move.
    pub fn space_from_cells(&self) -> DMat4 {
        match self {
            Self::Grid { grid, .. } => {
                DMat4::from_scale_rotation_translation(DVec3::splat(grid.span), glam::DQuat::IDENTITY, grid.anchor)
            }
            Self::Own { space_from_cells, .. } => *space_from_cells,
        }
    }

    /// The matrix of normals, up to scale.
    pub fn linear(&self) -> DMat3 {
        match self {
            Self::Grid { world_from_mesh, .. } => DMat3::from_mat4(*world_from_mesh),
            Self::Own { cells_from_mesh, .. } => DMat3::from_mat4(*cells_from_mesh),
        }
    }

    /// Equal bits mean equal caches.
    pub fn bits(&self) -> [u64; 16] {
        let matrix = match self {
            Self::Grid { world_from_mesh, .. } => world_from_mesh,
            Self::Own { cells_from_mesh, .. } => cells_from_mesh,
        };
        matrix.to_cols_array().map(f64::to_bits)
    }

    /// The rest pose is baked in: the object never moves by itself.
    pub fn is_grid(&self) -> bool {
        matches!(self, Self::Grid { .. })
    }
}

/// Normals through the stretch: sign(det)·cofactor, any length.
pub fn normals_in_cells(lattice: &Lattice, normals: &[Vec3]) -> Vec<DVec3> {
    // Scaled to the size of one, so that tiny spans do not underflow the cofactor.
    let linear = lattice.linear();
    let size = linear.x_axis.length().max(linear.y_axis.length()).max(linear.z_axis.length());
    let matrix = normal_matrix(&(linear * (1.0 / size.max(f64::MIN_POSITIVE))));
    normals.iter().map(|normal| (matrix * normal.as_dvec3()).normalize_or_zero()).collect()
}
