//! Voxel transformation (section 4.2): moves the cache voxels of every object in the grid into world
//! voxels, one thread a voxel. In: caches, parts, matrices. Out: `q`, normal, albedo a slot.

pub mod rigid;
pub mod rigid_ref;
pub mod skinned;
pub mod skinned_ref;

use bytemuck::{Pod, Zeroable};

use crate::data::pages::ListedVoxels;
use crate::gpu::{GpuBuffer, Kernel, Mirror, PassBuilder, mirror};

/// Mirror of `TransformParams` in shaders/shared/move_voxel.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TransformParams {
    pub grid_cells: i32,
    pub first_thread: u32,
}

/// A tile of an object's cache and what moves it. Mirror of `Part` in shaders/shared/part.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PartRecord {
    pub origin: [i32; 3],
    pub first_matrix: u32,
    pub joints_skew: u32,
    pub object: u32,
    pub emission_skew: u32,
    pub pad: u32,
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(TransformParams, "shared/move_voxel.wgsl", "TransformParams", grid_cells, first_thread),
    mirror!(PartRecord, "shared/part.wgsl", "Part", origin, first_matrix, joints_skew, object, emission_skew, pad),
];

/// The buffers of a transformation. Rigid parts come first in the work list, then skinned ones.
#[derive(Clone, Debug)]
pub struct MovingVoxels {
    pub listed: ListedVoxels,
    pub matrices: GpuBuffer,
    pub cache_voxels: GpuBuffer,
    /// Made only where a skin is in the scene.
    pub cache_joints: Option<GpuBuffer>,
    pub rigid_threads: u32,
}

impl MovingVoxels {
    pub fn skinned_threads(&self) -> u32 {
        self.listed.threads - self.rigid_threads
    }

    /// World voxels, the list that walks them, and what they are moved from.
    fn bind<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        self.listed
            .bind(pass)
            .bind("parts", &self.listed.parts)
            .bind("matrices", &self.matrices)
            .bind("cache_voxels", &self.cache_voxels)
    }
}
