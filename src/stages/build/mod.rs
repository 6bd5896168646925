//! Builds the octree's nodes without locks (section 4.3, by another route than Algorithm 1):
//! mark the leaves as bits, reduce two pyramids of masks, scan them, emit the nodes in key order.
//! Sizes are known after the scan, before anything is stored.

pub mod emit;
pub mod emit_ref;
pub mod mark;
pub mod mark_ref;
pub mod reduce;
pub mod reduce_ref;
pub mod scan;
pub mod scan_spread;
pub mod scan_spread_ref;
pub mod scan_sum;
pub mod scan_sum_ref;

/// Counter of the split weight that fell outside the grid, in 2^-24 voxels.
pub const COUNTER_CLIPPED: u32 = 0;
/// Counter of occupied leaves.
pub const COUNTER_LEAVES: u32 = 1;
/// 64-bit counters, two words each, cleared before a build.
pub const COUNTERS: u32 = 2;

use bytemuck::{Pod, Zeroable};

/// Uniform of the kernels that work on one level.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LevelParams {
    pub level: u32,
}
