// Look-ups in the block masks: a node's block is the rank of its bit.
#import shared/octree.wgsl

// Rank of the block that holds the children of node `key` of `level`, over all levels.
fn block_rank(level: u32, key: u32) -> u32 {
    let word = octree.levels[level].blocks_word + (key >> 5u);
    let bit = 1u << (key & 31u);
    let mask = blocks[word];
    if (mask & bit) == 0u {
        return NO_BLOCK;
    }
    return ranks[word] + countOneBits(mask & (bit - 1u));
}

// The same among leaf blocks alone (level depth − 1), counted from 0.
fn leaf_block_rank(key: u32) -> u32 {
    let rank = block_rank(octree.depth - 1u, key);
    if rank == NO_BLOCK {
        return NO_BLOCK;
    }
    return rank - octree.levels[octree.depth - 1u].first_block;
}

// Index of inner node `key` of `level`; NO_BLOCK where it is not allocated.
fn node_index(level: u32, key: u32) -> u32 {
    if level <= octree.dense_level {
        return octree.levels[level].first_node + key;
    }
    let block = block_rank(level - 1u, key >> 3u);
    if block == NO_BLOCK {
        return NO_BLOCK;
    }
    return octree.dense_node_count + 8u * block + (key & 7u);
}
