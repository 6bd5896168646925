//! The voxel cache: an object's voxels in its own space, made once (section 3.1, 4.2).
//!
//! Layout of a voxel, 16 bytes, as the GPU reads it:
//!
//! ```text
//! word 0  position  x 10 | y 10 | z 10 | 2 unused      cells from the tile's origin
//! word 1  normal    x 10 | y 10 | z 10 | 2 unused      biased, see packing; zero length: cancelled
//! word 2  albedo    r 8 | g 8 | b 8 | coverage 8       linear
//! word 3  surface   metallic 8 | roughness 8 | 16 unused
//! ```
//!
//! A cell's lattice coordinates are `tile.origin + position`; its centre is half a cell further.
//! Voxels of a tile are sorted by Morton key, each cell at most once.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::IVec3;
use serde::{Deserialize, Serialize};

/// Cells along an axis that a 10-bit position can address; larger objects are tiled.
pub const TILE_CELLS: i32 = 1024;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VoxelizationMode {
    /// 6-separating: the thinnest layer no axial step passes through.
    #[default]
    Thin,
    /// Every cell a triangle touches.
    Conservative,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct CacheVoxel {
    pub position: u32,
    pub normal: u32,
    pub albedo: u32,
    pub surface: u32,
}

/// Up to four joints of a skinned voxel; weights are integers that sum to exactly 255.
///
/// ```text
/// word 0  joint0 16 | joint1 16      word 1  joint2 16 | joint3 16
/// word 2  weight0 8 | weight1 8 | weight2 8 | weight3 8
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct VoxelJoints {
    pub joints: [u16; 4],
    pub weights: [u8; 4],
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoxelCache {
    pub tiles: Vec<Tile>,
    pub voxels: Vec<CacheVoxel>,
    /// Linear RGB emission a voxel; empty where nothing emits.
    pub emission: Vec<[f32; 3]>,
    /// As many as voxels for skinned meshes, else empty.
    pub joints: Vec<VoxelJoints>,
    pub report: VoxelizeReport,
}

/// A part of a cache that 10-bit positions can address. `origin` is in lattice cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    pub origin: IVec3,
    pub voxels: Range<u32>,
}

/// What voxelization counted; nothing is dropped without a number here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct VoxelizeReport {
    pub triangles: u64,
    /// Collinear or repeated-index triangles, which cover no area.
    pub degenerate_triangles: u64,
    /// Vertices whose weights were all zero: moved rigidly with the first joint.
    pub unweighted_vertices: u64,
}

impl VoxelCache {
    /// Lattice cell of every voxel, in storage order.
    pub fn cells(&self) -> impl Iterator<Item = IVec3> + '_ {
        self.tiles.iter().flat_map(|tile| {
            self.voxels[tile.voxels.start as usize..tile.voxels.end as usize].iter().map(|voxel| {
                tile.origin + IVec3::from_array(super::packing::unpack_position(voxel.position).map(|c| c as i32))
            })
        })
    }
}
