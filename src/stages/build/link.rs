//! Fills the neighbour pointers of all sparse levels (section 4.4), a block's or a node's.

use crate::data::octree::{OctreeParams, PointerLayout};
use crate::gpu::{Gpu, GpuBuffer, Recorder};

/// What linking reads.
#[derive(Clone, Debug)]
pub struct Linked {
    pub blocks: GpuBuffer,
    pub ranks: GpuBuffer,
    pub block_keys: GpuBuffer,
}

/// Writes `layout.words(octree)` words of `neighbours`.
pub fn record(
    gpu: &Gpu,
    frame: &mut Recorder,
    octree: &OctreeParams,
    linked: &Linked,
    (layout, neighbours): (PointerLayout, &GpuBuffer),
) {
    let blocks = u64::from(octree.block_count);
    let nodes = f64::from(u8::from(layout == PointerLayout::Nodes));
    frame
        .pass(&gpu.kernel("build/link.wgsl", &[("NODES", nodes)]))
        .uniform("octree", octree)
        .bind("blocks", &linked.blocks)
        .bind("ranks", &linked.ranks)
        .bind("block_keys", &linked.block_keys)
        .bind("neighbours", neighbours)
        .bytes_moved(blocks * (4 + 3 * 8) + 4 * layout.words(octree))
        .dispatch(blocks);
}
