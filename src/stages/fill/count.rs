//! First half of the counting sort: each voxel's leaf block and place.

use super::Filling;
use crate::data::octree::OctreeSizes;
use crate::gpu::{Gpu, Recorder};
use crate::settings::Filter;
use crate::stages::transform::MovingVoxels;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &MovingVoxels,
    octree: &OctreeSizes,
    filter: Filter,
    fill: &Filling,
) {
    let threads = u64::from(voxels.threads());
    frame
        .pass(&gpu.kernel("fill/count.wgsl", &[("SPLIT", filter.is_split())]))
        .bind("octree", &octree.buffer)
        .bind("work_items", &voxels.work_items)
        .bind("work_hints", &voxels.work_hints)
        .bind("world_voxels", &voxels.world_voxels)
        .bind("blocks", &fill.blocks)
        .bind("ranks", &fill.ranks)
        .bind("block_counts", &fill.block_counts)
        .bind("places", &fill.places)
        .bytes_moved(threads * (16 + 8 + 8))
        .dispatch(threads);
}
