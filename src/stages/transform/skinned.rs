//! Moves the voxels of skinned objects (section 3.2, "weighted linear transformations").

use super::{MovingVoxels, TransformParams};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

pub fn record(gpu: &Gpu, frame: &mut Recorder, voxels: &MovingVoxels, joints: &GpuBuffer, grid_cells: u32) {
    let threads = u64::from(voxels.skinned_threads);
    frame
        .pass(&gpu.kernel("transform/skinned.wgsl", &[]))
        .uniform("params", &TransformParams { grid_cells: grid_cells as i32, first_thread: voxels.rigid_threads })
        .bind("work_items", &voxels.work_items)
        .bind("work_hints", &voxels.work_hints)
        .bind("parts", &voxels.parts)
        .bind("matrices", &voxels.matrices)
        .bind("cache_voxels", &voxels.cache_voxels)
        .bind("cache_joints", joints)
        .bind("world_voxels", &voxels.world_voxels)
        .bytes_moved(threads * (16 + 12 + 16))
        .dispatch(threads);
}
