//! First half of the counting sort: each voxel's leaf block and place.

use super::Filling;
use crate::data::octree::OctreeSizes;
use crate::data::pages::ListedVoxels;
use crate::gpu::{Gpu, Recorder};
use crate::settings::Filter;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &ListedVoxels,
    octree: &OctreeSizes,
    filter: Filter,
    fill: &Filling,
) {
    let threads = u64::from(voxels.threads);
    let pass = frame.pass(&gpu.kernel("fill/count.wgsl", &[("SPLIT", filter.is_split())]));
    voxels
        .bind(pass)
        .bind("octree", &octree.buffer)
        .bind("blocks", &fill.blocks)
        .bind("ranks", &fill.ranks)
        .bind("block_counts", &fill.block_counts)
        .bind("places", &fill.places)
        .bytes_moved(threads * (16 + 8 + 8))
        .dispatch(threads);
}
