//! Second half of the counting sort: world voxels in block order.

use super::Filling;
use crate::data::pages::ListedVoxels;
use crate::gpu::{Gpu, Recorder};

pub fn record(gpu: &Gpu, frame: &mut Recorder, voxels: &ListedVoxels, fill: &Filling) {
    let threads = u64::from(voxels.threads);
    let pass = frame.pass(&gpu.kernel("fill/place.wgsl", &[]));
    voxels
        .bind(pass)
        .bind("places", &fill.places)
        .bind("block_starts", &fill.block_starts)
        .bind("sorted_voxels", &fill.sorted_voxels)
        .bytes_moved(threads * (16 + 8 + 16))
        .dispatch(threads);
}
