// Neighbour pointers (section 4.4): who lies ahead along x, y and z on the same level, for every
// sparse level at once, by look-up in the block masks. A thread a block.
//
// NODES false: 3 words a block, the rank of the neighbouring block; the pointers of its nodes follow
//              (shared/corners_linked.wgsl). A word serves four nodes on the block's forward face.
// NODES true:  3 words a node, the index of the neighbouring node: the paper's layout.
// NO_BLOCK where nothing is allocated or the grid ends.
#import shared/threads.wgsl
#import shared/block_rank.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> blocks: array<u32>;
@group(0) @binding(2) var<storage, read> ranks: array<u32>;
@group(0) @binding(3) var<storage, read> block_keys: array<u32>;
@group(0) @binding(4) var<storage, read_write> neighbours: array<u32>;

override WORKGROUP_SIZE: u32 = 64u;
override NODES: bool = false;

// Level of the node above a block: the blocks of each level lie together, the upper ones first.
fn level_of(block: u32) -> u32 {
    var level = octree.depth - 1u;
    while level > octree.dense_level && block < octree.levels[level].first_block {
        level -= 1u;
    }
    return level;
}

// Rank of the block ahead of that of node `key`; keys past the grid's edge outgrow the level.
fn block_ahead(level: u32, key: u32, axis: u32) -> u32 {
    let next = forward_key(key, axis);
    if next >= (1u << (3u * level)) {
        return NO_BLOCK;
    }
    return block_rank(level, next);
}

// Index of the node ahead of child `child`, given the block ahead of its own.
fn node_ahead(block: u32, child: u32, axis: u32, ahead: u32) -> u32 {
    let bit = 1u << axis;
    if (child & bit) == 0u {
        return octree.dense_node_count + 8u * block + (child | bit);
    }
    if ahead == NO_BLOCK {
        return NO_BLOCK;
    }
    return octree.dense_node_count + 8u * ahead + (child & ~bit);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= min(threads.end, octree.block_count) {
        return;
    }
    let level = level_of(block);
    let key = block_keys[block];
    for (var axis = 0u; axis < 3u; axis += 1u) {
        let ahead = block_ahead(level, key, axis);
        if NODES {
            for (var child = 0u; child < 8u; child += 1u) {
                neighbours[3u * (8u * block + child) + axis] = node_ahead(block, child, axis, ahead);
            }
        } else {
            neighbours[3u * block + axis] = ahead;
        }
    }
}
