//! Marks the leaves that voxels touch, and counts the weight that falls outside the grid.

use super::COUNTERS;
use crate::data::octree::{OctreeSizes, mask_words};
use crate::data::pages::ListedVoxels;
use crate::gpu::{Gpu, GpuBuffer, Recorder};
use crate::settings::Filter;

pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    voxels: &ListedVoxels,
    octree: &OctreeSizes,
    filter: Filter,
    leaf_bits: &GpuBuffer,
    counters: &GpuBuffer,
) {
    let threads = u64::from(voxels.threads);
    let mask_bytes = 4 * u64::from(mask_words(octree.params.depth));
    frame.clear_part(leaf_bits, mask_bytes);
    frame.clear_part(counters, 8 * u64::from(COUNTERS));
    let pass = frame.pass(&gpu.kernel("build/mark.wgsl", &[("SPLIT", filter.is_split())]));
    voxels
        .bind(pass)
        .bind("octree", &octree.buffer)
        .bind("leaf_bits", leaf_bits)
        .bind("counters", counters)
        .bytes_moved(threads * 16 + mask_bytes)
        .dispatch(threads);
}
