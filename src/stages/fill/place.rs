//! Second half of the counting sort: world voxels in block order.

use super::Filling;
use crate::gpu::{Gpu, Recorder};
use crate::stages::transform::MovingVoxels;

pub fn record(gpu: &Gpu, frame: &mut Recorder, voxels: &MovingVoxels, fill: &Filling) {
    let threads = u64::from(voxels.threads());
    let pass = frame.pass(&gpu.kernel("fill/place.wgsl", &[]));
    voxels
        .bind_world(pass)
        .bind("places", &fill.places)
        .bind("block_starts", &fill.block_starts)
        .bind("sorted_voxels", &fill.sorted_voxels)
        .bytes_moved(threads * (16 + 8 + 16))
        .dispatch(threads);
}
