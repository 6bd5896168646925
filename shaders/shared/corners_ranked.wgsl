// Nodes around a point by rank look-up in the block masks: no pointers, no descent. The kernel declares
// `blocks`, `ranks`, `leaf_bits` and `block_starts`.
#import shared/corners.wgsl
#import shared/block_rank.wgsl

fn ranked_entry(level: u32, node: vec3<i32>) -> u32 {
    let key = morton_key(vec3<u32>(node));
    if level <= octree.dense_level {
        return octree.levels[level].first_node + key;
    }
    return light_entry(level, key, block_rank(level - 1u, key >> 3u));
}

// Corners share a block along the axes where the base is even, and its rank is looked up once.
fn ranked_corners(level: u32, base: vec3<i32>) -> Corners {
    let cells = i32(1u << level);
    if !reaches_level(base, cells) {
        return no_corners();
    }
    if level <= octree.dense_level {
        return dense_corners(level, base);
    }
    let odd = axis_bits((base & vec3<i32>(1)) == vec3<i32>(1));
    var corners = no_corners();
    var block_of: array<u32, 8>;
    for (var j = 0u; j < 8u; j += 1u) {
        let node = base + vec3<i32>(corner_offset(j));
        if !node_in_level(node, cells) {
            continue;
        }
        let key = morton_key(vec3<u32>(node));
        if (j & ~odd) == 0u {
            block_of[j] = block_rank(level - 1u, key >> 3u);
        }
        corners.entries[j] = light_entry(level, key, block_of[j & odd]);
    }
    return corners;
}
