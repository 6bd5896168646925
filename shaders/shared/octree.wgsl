// The octree's index arithmetic; data::octree draws the layout. A kernel declares those of the
// buffers `occupied`, `blocks`, `ranks` that it looks into.
//
// `octree` tells the truth; more threads may run than it counts, and end there. Without leaf blocks there is
// no octree, or no room for it: nothing may be written by rank.
//
//   occupied  one bit a node, levels 0 ..= depth − 1: truly occupied, O(l)
//   blocks    one bit a node, levels dense ..= depth − 1: its 8 children are allocated, A(l)
//   ranks     exclusive prefix sum of the set bits of `blocks`, a number a word
#import constants
#import shared/morton.wgsl

struct OctreeLevel {
    // Word offsets of the level in `occupied` and `blocks`.
    occupied_word: u32,
    blocks_word: u32,
    // Rank of the level's first block; for levels below the dense one, unused.
    first_block: u32,
    // Index of the level's first node: dense levels in Morton order, sparse ones in block order.
    first_node: u32,
}

struct OctreeParams {
    depth: u32,
    dense_level: u32,
    // Blocks of all levels, and of the last (the leaf blocks).
    block_count: u32,
    leaf_block_count: u32,
    // Inner nodes: all levels but the leaves.
    inner_node_count: u32,
    leaf_count: u32,
    // Nodes of the dense levels; sparse node 8r + c of block r follows them.
    dense_node_count: u32,
    pad: u32,
    levels: array<OctreeLevel, 12>,
}

// Nodes stored at an inner level, dummies included.
fn level_node_count(level: u32) -> u32 {
    var end = octree.inner_node_count;
    if level + 1u < octree.depth {
        end = octree.levels[level + 1u].first_node;
    }
    return end - octree.levels[level].first_node;
}

fn grid_cells() -> i32 {
    return i32(1u << octree.depth);
}

fn inside_grid(cell: vec3<i32>) -> bool {
    return all(cell >= vec3<i32>(0)) && all(cell < vec3<i32>(grid_cells()));
}
