//! Fragments: the cells that the posed triangles cover, and what of them lies in each.

use super::CellStore;
use crate::data::fragments::{FragmentCounts, PosedTriangles};
use crate::gpu::{Counted, Gpu, GpuBuffer, Recorder};
use crate::settings::VoxelizationMode;

/// `columns`: as many as there may be. `starts`: by triangle.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    (triangles, mode): (&PosedTriangles, VoxelizationMode),
    (columns, starts): (u32, &GpuBuffer),
    store: &CellStore,
) {
    let constants = store.constants().into_iter().chain([("CONSERVATIVE", mode.is_conservative())]);
    let kernel = gpu.kernel("voxelize/cover.wgsl", &constants.collect::<Vec<_>>());
    let fragment_bytes = store.fragment_bytes();
    for batch in &triangles.batches {
        let pass = triangles.bind(frame.pass(&kernel), batch);
        pass.uniform("room", &store.room)
            .bind("starts", starts)
            .bind("heads", &store.heads)
            .bind("fragments", &store.fragments)
            .counted(&store.counts, move |counts: &FragmentCounts| Counted {
                threads: u64::from(counts.columns),
                bytes: u64::from(counts.columns) * 4 + u64::from(counts.fragments) * (fragment_bytes + 8),
            })
            .dispatch(u64::from(columns));
    }
    frame.copy(&store.heads, 0, &store.counts, 4, 4);
}
