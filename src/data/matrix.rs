//! Affine maps as the GPU reads them.

use bytemuck::{Pod, Zeroable};

use crate::gpu::{Mirror, mirror};

/// Row by row: of voxels a cache position to cell coordinates, of triangles a position to the space that is drawn in.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Matrix3x4 {
    pub rows: [[f32; 4]; 3],
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(Matrix3x4, "shared/move_voxel.wgsl", "Matrix3x4", rows),
    mirror!(Matrix3x4, "shared/posed_mesh.wgsl", "MeshMatrix", rows),
];
