//! Moves the voxels of skinned objects (section 3.2, "weighted linear transformations").

use super::{MovingVoxels, TransformParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

pub fn record(gpu: &Gpu, frame: &mut Recorder, voxels: &MovingVoxels, joints: &GpuBuffer, grid_cells: u32) {
    let threads = u64::from(voxels.skinned_threads());
    let pass = frame.pass(&gpu.kernel("transform/skinned.wgsl", &[]));
    voxels
        .bind(pass)
        .uniform("params", &TransformParams { grid_cells: grid_cells as i32, first_thread: voxels.rigid_threads })
        .bind("cache_joints", joints)
        .bytes_moved(threads * (16 + 12 + 16))
        .dispatch(threads);
}
