//! Fills the neighbour pointers of all sparse levels (section 4.4), a block's or a node's.

use crate::data::octree::{OctreeParams, OctreeSizes, PointerLayout};
use crate::gpu::{Counted, Gpu, GpuBuffer, Recorder};

/// What linking reads.
#[derive(Clone, Debug)]
pub struct Linked {
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_keys: GpuBuffer,
}

/// Writes `layout.words(…)` words of `neighbours`.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeSizes,
    linked: &Linked,
    (layout, neighbours): (PointerLayout, &GpuBuffer),
) {
    let nodes = f64::from(u8::from(layout == PointerLayout::Nodes));
    frame
        .pass(&gpu.kernel("build/link.wgsl", &[("NODES", nodes)]))
        .bind("octree", &octree.buffer)
        .bind("blocks", &linked.blocks)
        .bind("ranks", &linked.ranks)
        .bind("block_keys", &linked.block_keys)
        .bind("neighbours", neighbours)
        .counted(&octree.buffer, move |octree: &OctreeParams| Counted {
            threads: octree.block_count.into(),
            bytes: u64::from(octree.block_count) * (4 + 3 * 8) + 4 * layout.words(octree),
        })
        .dispatch(octree.params.block_count.into());
}
