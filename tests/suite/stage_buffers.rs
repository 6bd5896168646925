//! Buffers of a build, full of what no kernel has written.

use octolume::data::octree::{MAX_FRAGMENTS, OctreeSizes, Slot};
use octolume::gpu::{Gpu, GpuBuffer};
use octolume::stages::build::emit;
use octolume::stages::fill::Filling;

use crate::stage_build::OctreeBuffers;

/// A new buffer is full of ones, so that whatever is not written shows; an old one keeps its contents.
pub fn dirty(gpu: &Gpu, slot: &mut Slot, label: &str, words: u64) -> GpuBuffer {
    let is_new = slot.get().is_none_or(|buffer| buffer.bytes() < 4 * words);
    let buffer = slot.ensure(gpu, label, 4 * words).unwrap_or_else(|error| panic!("{error}"));
    if is_new {
        gpu.write(&buffer, 0, &vec![0xff; buffer.bytes() as usize]).unwrap_or_else(|error| panic!("{error}"));
    }
    buffer
}

/// What is filled behind the masks.
pub struct OutBuffers {
    pub emitted: emit::Emitted,
    pub fill: Filling,
    pub leaf_objects: GpuBuffer,
}

impl OutBuffers {
    pub fn new(gpu: &Gpu, sizes: &OctreeSizes, voxels: u32, buffers: &mut OctreeBuffers) -> Self {
        let params = &sizes.params;
        let leaf_blocks = u64::from(params.leaf_block_count);
        let (inner_nodes, leaves) = (u64::from(params.inner_node_count), u64::from(params.leaf_count));
        let (t, p) = (&mut buffers.topology, &mut buffers.payload);
        for (slot, label, words) in [
            (&mut t.block_keys, "block keys", u64::from(params.block_count)),
            (&mut t.first_child, "first child", inner_nodes),
            (&mut t.block_counts, "leaves of blocks", 2 * leaf_blocks),
            (&mut p.block_counts, "block counts", 2 * leaf_blocks),
            (&mut p.block_starts, "block starts", 2 * (leaf_blocks + 1)),
            (&mut p.places, "places", 2 * u64::from(voxels)),
            (&mut p.sorted_voxels, "sorted voxels", 4 * u64::from(voxels)),
            (&mut p.leaves, "leaves", 3 * leaves),
            (&mut p.nodes, "nodes", 4 * inner_nodes),
            (&mut p.heavy_blocks, "heavy blocks", heavy_words(voxels.into())),
        ] {
            dirty(gpu, slot, label, words);
        }
        let emitted = emit::Emitted::new(gpu, sizes, t).expect("fits");
        let fill = Filling::new(gpu, sizes, &buffers.masks, t, p, voxels).expect("fits");
        let leaf_objects = dirty(gpu, &mut buffers.leaf_objects, "leaf objects", leaves);
        Self { emitted, fill, leaf_objects }
    }
}

pub fn heavy_words(voxels: u64) -> u64 {
    2 + 8 * voxels / u64::from(MAX_FRAGMENTS)
}
