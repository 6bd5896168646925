// Where an occupied leaf is stored. A kernel declares `leaf_bits`, `blocks`, `ranks` and `block_starts`.
#import shared/block_rank.wgsl
#import shared/leaf_mask.wgsl

// Place among the occupied leaves of an occupied leaf.
fn leaf_slot(key: u32) -> u32 {
    let below = leaf_mask(key >> 3u) & ((1u << (key & 7u)) - 1u);
    return block_starts[2u * leaf_block_rank(key >> 3u) + 1u] + countOneBits(below);
}
