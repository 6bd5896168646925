//! Gathers the emission of each leaf from the voxels that reach it.

use super::Filling;
use super::place_emission::Emission;
use crate::data::octree::OctreeParams;
use crate::gpu::{Gpu, Recorder};
use crate::settings::Filter;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeParams,
    filter: Filter,
    fill: &Filling,
    emission: &Emission,
) {
    let blocks = u64::from(octree.leaf_block_count);
    frame.clear(&emission.leaf_emission);
    frame
        .pass(&gpu.kernel("fill/gather_emission.wgsl", &[("SPLIT", filter.is_split())]))
        .uniform("octree", octree)
        .bind("blocks", &fill.blocks)
        .bind("ranks", &fill.ranks)
        .bind("block_keys", &fill.block_keys)
        .bind("block_starts", &fill.block_starts)
        .bind("sorted_voxels", &fill.sorted_voxels)
        .bind("sorted_emission", &emission.sorted_emission)
        .bind("emitting_blocks", &emission.emitting_blocks)
        .bind("leaf_emission", &emission.leaf_emission)
        .bytes_moved(emission.sorted_emission.bytes() + emission.leaf_emission.bytes() + blocks * (4 + 8 + 4))
        .dispatch(blocks);
}
