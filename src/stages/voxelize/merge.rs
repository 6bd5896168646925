//! One world voxel of all fragments that an object leaves in a cell.

use super::CellStore;
use crate::data::fragments::FragmentCounts;
use crate::data::pages::{ListedVoxels, WORLD_VOXEL_BYTES};
use crate::gpu::{Counted, Gpu, GpuBuffer, Recorder};

/// `voxel_count`: a word. `emission`: two words a voxel, where something emits.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    store: &CellStore,
    listed: &ListedVoxels,
    (voxel_count, emission): (&GpuBuffer, &GpuBuffer),
) {
    frame.clear_part(&listed.world_voxels, WORLD_VOXEL_BYTES * u64::from(store.room.voxels));
    frame.clear_part(voxel_count, 4);
    frame
        .pass(&gpu.kernel("voxelize/merge.wgsl", &store.constants()))
        .uniform("room", &store.room)
        .bind("counts", &store.counts)
        .bind("heads", &store.heads)
        .bind("fragments", &store.fragments)
        .bind("voxel_count", voxel_count)
        .bind("world_voxels", &listed.world_voxels)
        .bind("voxel_objects", &listed.work_hints)
        .bind("voxel_emission", emission)
        .counted(&store.counts, |counts: &FragmentCounts| Counted {
            threads: u64::from(counts.fragments),
            bytes: u64::from(counts.fragments) * 24 + u64::from(counts.voxels) * 20,
        })
        .dispatch(u64::from(store.room.fragments));
    frame.copy(voxel_count, 0, &store.counts, 8, 4);
}
