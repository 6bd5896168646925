// Nodes around a point by rank look-up in the block masks: no pointers, no descent. The kernel declares
// `blocks`, `ranks`, `leaf_bits` and `block_starts`.
#import shared/corners.wgsl
#import shared/block_rank.wgsl

// The block of node `key` of a sparse level.
fn ranked_block(level: u32, key: u32) -> BlockLight {
    var children = 0u;
    if level == octree.depth {
        children = leaf_mask(key >> 3u);
        // Most of space ends here.
        if children == 0u {
            return NO_LIGHT;
        }
    }
    let block = block_rank(level - 1u, key >> 3u);
    if block == NO_BLOCK {
        return NO_LIGHT;
    }
    return block_light(level, block, children);
}

// Whether the block of node `key` of a sparse level is allocated.
fn has_block(level: u32, key: u32) -> bool {
    let mask = blocks[octree.levels[level - 1u].blocks_word + (key >> 8u)];
    return ((mask >> ((key >> 3u) & 31u)) & 1u) != 0u;
}

fn ranked_entry(level: u32, node: vec3<i32>) -> u32 {
    let key = morton_key(vec3<u32>(node));
    if level <= octree.dense_level {
        return octree.levels[level].first_node + key;
    }
    return entry_in(ranked_block(level, key), key);
}

fn ranked_corners(level: u32, base: vec3<i32>) -> Corners {
    if level <= octree.dense_level {
        return dense_corners(level, base);
    }
    let way = way_from(base, i32(1u << level));
    var corners = no_corners();
    // Without the first node none of the eight is occupied: it would be their dummy.
    if !has_block(level, key_after(way, 0u)) {
        return corners;
    }
    var blocks_after: array<BlockLight, 8>;
    for (var hops = 0u; hops < 8u; hops += 1u) {
        if (hops & way.closed) != 0u {
            continue;
        }
        let key = key_after(way, hops);
        if (hops & ~way.odd) == 0u {
            blocks_after[hops] = ranked_block(level, key);
        }
        corners.entries[hops | way.below] = entry_in(blocks_after[hops & way.odd], key);
    }
    return corners;
}
