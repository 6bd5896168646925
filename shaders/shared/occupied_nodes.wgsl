// Which nodes hold something. A kernel declares `leaf_bits` and `occupied`.
#import shared/octree.wgsl

fn node_occupied(level: u32, key: u32) -> bool {
    if level == octree.depth {
        return ((leaf_bits[key >> 5u] >> (key & 31u)) & 1u) != 0u;
    }
    return ((occupied[octree.levels[level].occupied_word + (key >> 5u)] >> (key & 31u)) & 1u) != 0u;
}
