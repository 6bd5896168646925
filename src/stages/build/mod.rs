//! Builds the octree's nodes without locks (section 4.3, by another route than Algorithm 1):
//! mark the leaves as bits, reduce two pyramids of masks, scan them, emit the nodes in key order, and
//! link them to their forward neighbours (section 4.4).
//! The scan knows the sizes; `size` puts them down on the GPU, before anything is stored.

pub mod emit;
pub mod emit_ref;
pub mod link;
pub mod link_ref;
pub mod mark;
pub mod mark_ref;
pub mod reduce;
pub mod reduce_ref;
pub mod scan;
pub mod scan_spread;
pub mod scan_spread_ref;
pub mod scan_sum;
pub mod scan_sum_ref;
pub mod size;
pub mod size_ref;

use bytemuck::{Pod, Zeroable};

use crate::data::octree::MAX_DEPTH;
use crate::gpu::{Constant, Mirror, constants, mirror};

/// Counter of the split weight that fell outside the grid, in 2^-24 voxels.
pub const COUNTER_CLIPPED: u32 = 0;
/// Counter of the occupied nodes of level 0; those of levels 1 … depth follow.
pub const COUNTER_OCCUPIED: u32 = 1;

/// Values that one thread sums.
pub const SCAN_CHUNK: u32 = 64;

pub const CONSTANTS: &[Constant] = constants![
    integer COUNTER_CLIPPED,
    integer COUNTER_OCCUPIED,
    integer SCAN_CHUNK,
];

/// 64-bit counters, two words each, cleared before a build.
pub const COUNTERS: u32 = COUNTER_OCCUPIED + MAX_DEPTH + 1;

/// Uniform of the kernels that work on one level.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LevelParams {
    pub level: u32,
}

/// Mirror of `ScanParams` in shaders/shared/scan.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ScanParams {
    pub count: u32,
}

pub const MIRRORS: &[Mirror] = &[
    mirror!(LevelParams, "build/reduce.wgsl", "ReduceParams", level),
    mirror!(LevelParams, "build/emit.wgsl", "EmitParams", level),
    mirror!(LevelParams, "averaging/average.wgsl", "AverageParams", level),
    mirror!(LevelParams, "light/average_light.wgsl", "AverageLightParams", level),
    mirror!(ScanParams, "shared/scan.wgsl", "ScanParams", count),
];
