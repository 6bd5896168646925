//! Moves the voxels of static and rigid objects (section 3.2, "basic linear transformations").

use super::{MovingVoxels, TransformParams};
use crate::gpu::{Gpu, Recorder};

pub fn record(gpu: &Gpu, frame: &mut Recorder, voxels: &MovingVoxels, grid_cells: u32) {
    let threads = u64::from(voxels.rigid_threads);
    let pass = frame.pass(&gpu.kernel("transform/rigid.wgsl", &[]));
    voxels
        .bind(pass)
        .uniform("params", &TransformParams { grid_cells: grid_cells as i32, first_thread: 0 })
        .bytes_moved(threads * (16 + 16))
        .dispatch(threads);
}
