// Writes the nodes: block r's children are nodes dense + 8r … dense + 8r + 7, in key order, the same
// in every run. A thread takes one word of the block masks of its level. Out: each block's key, the
// child pointer of the node above it, and for leaf blocks the number of occupied leaves.
#import shared/threads.wgsl
#import shared/block_rank.wgsl
#import shared/leaf_mask.wgsl

struct EmitParams {
    level: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: EmitParams;
@group(0) @binding(2) var<storage, read> blocks: array<u32>;
@group(0) @binding(3) var<storage, read> ranks: array<u32>;
@group(0) @binding(4) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(5) var<storage, read_write> block_keys: array<u32>;
@group(0) @binding(6) var<storage, read_write> first_child: array<u32>;
// Voxels (counted later) and leaves of each leaf block.
@group(0) @binding(7) var<storage, read_write> block_counts: array<u32>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end || octree.leaf_block_count == 0u {
        return;
    }
    let level = params.level;
    let word = octree.levels[level].blocks_word + thread;
    var mask = blocks[word];
    var block = ranks[word];
    while mask != 0u {
        let key = 32u * thread + firstTrailingBit(mask);
        block_keys[block] = key;
        first_child[node_index(level, key)] = octree.dense_node_count + 8u * block;
        if level + 1u == octree.depth {
            let children = leaf_mask(key);
            let leaf_block = block - octree.levels[level].first_block;
            block_counts[2u * leaf_block] = 0u;
            block_counts[2u * leaf_block + 1u] = countOneBits(children);
        }
        mask &= mask - 1u;
        block += 1u;
    }
}
