//! Gathers the emission of each leaf from the voxels that reach it.

use super::Filling;
use super::place_emission::Emission;
use crate::data::octree::{OctreeParams, OctreeSizes};
use crate::gpu::{Counted, Gpu, Recorder};
use crate::settings::Filter;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeSizes,
    filter: Filter,
    fill: &Filling,
    emission: &Emission,
) {
    let emission_bytes = 8 * u64::from(emission.voxels);
    frame.clear_part(&emission.leaf_emission, 12 * u64::from(octree.params.leaf_count));
    let pass = frame.pass(&gpu.kernel("fill/gather_emission.wgsl", &[("SPLIT", filter.is_split())]));
    fill.bind_sources(pass, octree)
        .bind("sorted_emission", &emission.sorted_emission)
        .bind("emitting_blocks", &emission.emitting_blocks)
        .bind("leaf_emission", &emission.leaf_emission)
        .counted(&octree.buffer, move |octree: &OctreeParams| {
            let threads = u64::from(octree.leaf_block_count);
            Counted { threads, bytes: emission_bytes + 12 * u64::from(octree.leaf_count) + threads * (4 + 8 + 4) }
        })
        .dispatch(octree.params.leaf_block_count.into());
}
