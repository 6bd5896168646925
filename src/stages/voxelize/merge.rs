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
    // All threads walk the one item of the list.
    frame.clear_part(&listed.work_hints, 4 * u64::from(store.room.hints));
    frame.clear_part(voxel_count, 4);
    let fragment_bytes = store.fragment_bytes();
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
        .counted(&store.counts, move |counts: &FragmentCounts| Counted {
            threads: u64::from(counts.fragments),
            bytes: u64::from(counts.fragments) * fragment_bytes + u64::from(counts.voxels) * 20,
        })
        .dispatch(u64::from(store.room.fragments));
    frame.copy(voxel_count, 0, &store.counts, 8, 4);
}
