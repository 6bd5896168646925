//! Gathers each leaf block's voxels into its leaves and the node above them.

use super::Filling;
use crate::data::octree::{OctreeParams, OctreeSizes};
use crate::data::pages::ListedVoxels;
use crate::data::pages::WORLD_VOXEL_BYTES;
use crate::gpu::{Counted, Gpu, Recorder};
use crate::settings::Filter;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &ListedVoxels,
    octree: &OctreeSizes,
    filter: Filter,
    fill: &Filling,
) {
    let voxel_bytes = WORLD_VOXEL_BYTES * u64::from(voxels.threads);
    let pass = frame.pass(&gpu.kernel("fill/gather.wgsl", &[("SPLIT", filter.is_split())]));
    fill.bind_sources(pass, octree)
        .bind("leaves", &fill.leaves)
        .bind("nodes", &fill.nodes)
        .bind("heavy_blocks", &fill.heavy_blocks)
        .counted(&octree.buffer, move |octree: &OctreeParams| {
            let threads = u64::from(octree.leaf_block_count);
            Counted { threads, bytes: voxel_bytes + 12 * u64::from(octree.leaf_count) + threads * (4 + 8 + 16) }
        })
        .dispatch(octree.params.leaf_block_count.into());
}
