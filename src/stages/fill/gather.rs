//! Gathers each leaf block's voxels into its leaves and the node above them.

use super::Filling;
use crate::data::octree::OctreeParams;
use crate::gpu::{Gpu, Recorder};
use crate::settings::Filter;

pub fn record(gpu: &Gpu, frame: &mut Recorder, octree: &OctreeParams, filter: Filter, fill: &Filling) {
    let blocks = u64::from(octree.leaf_block_count);
    frame
        .pass(&gpu.kernel("fill/gather.wgsl", &[("SPLIT", filter.is_split())]))
        .uniform("octree", octree)
        .bind("blocks", &fill.blocks)
        .bind("ranks", &fill.ranks)
        .bind("block_keys", &fill.block_keys)
        .bind("block_starts", &fill.block_starts)
        .bind("sorted_voxels", &fill.sorted_voxels)
        .bind("leaves", &fill.leaves)
        .bind("nodes", &fill.nodes)
        .bind("heavy_blocks", &fill.heavy_blocks)
        .bytes_moved(fill.sorted_voxels.bytes() + 12 * u64::from(octree.leaf_count) + blocks * (4 + 8 + 16))
        .dispatch(blocks);
}
