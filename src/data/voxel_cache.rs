//! The voxel cache: an object's voxels in its own space, made once (section 3.1, 4.2).
//!
//! Layout of a voxel, 16 bytes, as the GPU reads it:
//!
//! ```text
//! word 0  position  x 10 | y 10 | z 10 | 2 unused      cells from the tile's origin
//! word 1  normal    x 10 | y 10 | z 10 | 2 unused      biased, see packing; zero length: cancelled
//! word 2  albedo    r 8 | g 8 | b 8 | coverage 8       see albedo
//! word 3  surface   metallic 8 | roughness 8 | 16 unused
//! ```
//!
//! A cell's lattice coordinates are `tile.origin + position`; its centre is half a cell further.
//! Voxels of a tile are sorted by Morton key, each cell at most once.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::IVec3;
use serde::{Deserialize, Serialize};

use super::grid::morton_key;
use super::packing::{NORMAL_MAX, unpack_position};
use crate::gpu::{Constant, constants};

/// Cells along an axis that a 10-bit position can address; larger objects are tiled.
pub const TILE_CELLS: i32 = 1024;

pub const CONSTANTS: &[Constant] = constants![
    integer TILE_CELLS = TILE_CELLS as u32,
];

/// What the joint weights of a voxel sum to.
pub const JOINT_WEIGHT_SUM: u32 = 255;

/// No cell lies farther from the lattice's origin along an axis.
pub const MAX_COORDINATE_CELLS: i32 = 1 << 30;

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
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tile {
    pub origin: IVec3,
    pub voxels: Range<u32>,
}

/// What voxelization counted; nothing is dropped without a number here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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
            self.voxels[tile.voxels.start as usize..tile.voxels.end as usize]
                .iter()
                .map(|voxel| tile.origin + IVec3::from_array(unpack_position(voxel.position).map(|c| c as i32)))
        })
    }
}

impl VoxelCache {
    /// Does all hold that the other stages rely on? If not, what does not. For caches that come from
    /// outside the program.
    pub fn validate(&self) -> Result<(), &'static str> {
        let fits = |len: usize| len == 0 || len == self.voxels.len();
        if !(fits(self.emission.len()) && fits(self.joints.len())) {
            return Err("emission or joints are not as many as voxels");
        }
        let mut next = 0;
        for tile in &self.tiles {
            let Range { start, end } = tile.voxels;
            if start != next || end <= start || end as usize > self.voxels.len() {
                return Err("tiles do not follow one another");
            }
            let reach = IVec3::splat(MAX_COORDINATE_CELLS);
            if !(tile.origin.cmpge(-reach).all() && tile.origin.cmple(reach).all()) {
                return Err("a tile is out of reach");
            }
            if !is_tile(&self.voxels[start as usize..end as usize]) {
                return Err("voxels are not in Morton order, or use bits that have no meaning");
            }
            next = end;
        }
        let weighs_one = |joints: &VoxelJoints| joints.weights.map(u32::from).iter().sum::<u32>() == JOINT_WEIGHT_SUM;
        let is_light = |emission: &[f32; 3]| emission.iter().all(|value| value.is_finite() && *value >= 0.0);
        match () {
            () if next as usize != self.voxels.len() => Err("voxels are in no tile"),
            () if !self.joints.iter().all(weighs_one) => Err("joint weights do not sum to 255"),
            () if !self.emission.iter().all(is_light) => Err("emission is negative or not finite"),
            () => Ok(()),
        }
    }
}

/// Sorted by Morton key, each cell once, unused bits zero, normals in their range.
fn is_tile(voxels: &[CacheVoxel]) -> bool {
    let is_voxel = |voxel: &CacheVoxel| {
        let components = unpack_position(voxel.normal);
        voxel.position >> 30 == 0
            && voxel.normal >> 30 == 0
            && components.iter().all(|&component| component <= 2 * NORMAL_MAX as u32)
    };
    let key = |voxel: &CacheVoxel| morton_key(unpack_position(voxel.position));
    voxels.iter().all(is_voxel) && voxels.is_sorted_by(|a, b| key(a) < key(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn voxel(position: u32) -> CacheVoxel {
        CacheVoxel { position, normal: 511 | 511 << 10 | 1022 << 20, albedo: u32::MAX, surface: 0 }
    }

    fn cache() -> VoxelCache {
        VoxelCache {
            tiles: vec![
                Tile { origin: IVec3::ZERO, voxels: 0..2 },
                Tile { origin: IVec3::X * TILE_CELLS, voxels: 2..3 },
            ],
            voxels: vec![voxel(0), voxel(1 << 10), voxel(0)],
            emission: vec![[0.5; 3]; 3],
            joints: vec![VoxelJoints { joints: [1, 0, 0, 0], weights: [254, 1, 0, 0] }; 3],
            report: VoxelizeReport::default(),
        }
    }

    #[test]
    fn what_no_stage_could_use_is_told() {
        assert_eq!(cache().validate(), Ok(()));
        assert_eq!(VoxelCache::default().validate(), Ok(()));
        let broken: [fn(&mut VoxelCache); 13] = [
            |cache| cache.tiles[1].voxels = 1..3,
            |cache| cache.tiles[1].voxels = 2..4,
            |cache| cache.tiles[0].voxels = 0..0,
            |cache| cache.tiles.truncate(1),
            |cache| cache.tiles[0].origin.y = i32::MIN,
            |cache| cache.voxels.swap(0, 1),
            |cache| cache.voxels[1] = cache.voxels[0],
            |cache| cache.voxels[2].position |= 1 << 30,
            |cache| cache.voxels[2].normal |= 0x3ff,
            |cache| cache.emission.truncate(2),
            |cache| cache.emission[1][2] = f32::NAN,
            |cache| cache.joints.truncate(1),
            |cache| cache.joints[1].weights[1] = 2,
        ];
        for (number, spoil) in broken.into_iter().enumerate() {
            let mut cache = cache();
            spoil(&mut cache);
            assert!(cache.validate().is_err(), "{number}");
        }
    }
}
