//! How many columns of cells each posed triangle may cover.

use crate::data::fragments::PosedTriangles;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::settings::VoxelizationMode;

/// `columns`: a word a triangle. `total`: their sum, two words.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    (triangles, mode): (&PosedTriangles, VoxelizationMode),
    (columns, total): (&GpuBuffer, &GpuBuffer),
) {
    frame.clear_part(total, 8);
    let kernel = gpu.kernel("voxelize/count.wgsl", &[("CONSERVATIVE", mode.is_conservative())]);
    for batch in &triangles.batches {
        let threads = u64::from(batch.list.end_triangle - batch.list.first_triangle);
        triangles
            .bind(frame.pass(&kernel), batch)
            .bind("columns", columns)
            .bind("counters", total)
            .bytes_moved(threads * (3 * (4 + 12) + 4))
            .dispatch(threads);
    }
}
