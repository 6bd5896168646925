// Where a leaf block lies. A kernel declares `block_keys`, of all levels.
#import shared/octree.wgsl

// Key of the node whose children are leaf block number `block`.
fn leaf_block_key(block: u32) -> u32 {
    return block_keys[octree.levels[octree.depth - 1u].first_block + block];
}
