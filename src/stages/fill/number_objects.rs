//! Numbers each leaf with the object that fills it most, where somebody looks at objects.

use super::Filling;
use crate::data::octree::{OctreeParams, OctreeSizes};
use crate::data::pages::ListedVoxels;
use crate::gpu::{Constant, Counted, Gpu, GpuBuffer, Recorder, constants};
use crate::settings::Filter;

/// One word a leaf; the object is `OBJECT_MASK − (word & OBJECT_MASK)`.
pub const OBJECT_MASK: u32 = 0xffff;

pub const CONSTANTS: &[Constant] = constants![
    integer OBJECT_MASK,
];

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &ListedVoxels,
    (octree, filter): (&OctreeSizes, Filter),
    fill: &Filling,
    (leaf_bits, leaf_objects): (&GpuBuffer, &GpuBuffer),
) {
    let threads = u64::from(voxels.threads);
    frame.clear_part(leaf_objects, 4 * u64::from(octree.params.leaf_count));
    let pass = frame.pass(&gpu.kernel("fill/number_objects.wgsl", &[("SPLIT", filter.is_split())]));
    voxels
        .bind(pass)
        .bind("octree", &octree.buffer)
        .bind("blocks", &fill.blocks)
        .bind("ranks", &fill.ranks)
        .bind("leaf_bits", leaf_bits)
        .bind("block_starts", &fill.block_starts)
        .bind("leaf_objects", leaf_objects)
        .counted(&octree.buffer, move |octree: &OctreeParams| Counted {
            threads,
            bytes: threads * 16 + u64::from(octree.leaf_count) * 4,
        })
        .dispatch(threads);
}
