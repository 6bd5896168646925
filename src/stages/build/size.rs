//! How large the octree is: known on the GPU after the scan, checked against a prediction.

use crate::data::octree::{MaskBuffers, OctreeParams, OctreeSizes};
use crate::gpu::{Gpu, GpuError, Recorder};

/// Writes the true sizes where `predicted.params` have room for them, else those of an octree without blocks: what
/// is recorded behind it does nothing then, and has to run again with larger buffers.
pub fn record(gpu: &Gpu, frame: &mut Recorder, predicted: &OctreeSizes, masks: &MaskBuffers) -> Result<(), GpuError> {
    let levels = u64::from(predicted.params.depth - predicted.params.dense_level);
    frame
        .pass(&gpu.kernel("build/size.wgsl", &[]))
        .uniform("room", &predicted.params)
        .bind("ranks", &masks.ranks.made("block ranks")?)
        .bind("counters", &masks.counters.made("counters")?)
        .bind("octree", &predicted.buffer)
        .bytes_moved(4 * (levels + 1) + 4 + size_of::<OctreeParams>() as u64)
        .dispatch(1);
    Ok(())
}
