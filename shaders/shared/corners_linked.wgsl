// Nodes around a point as the paper reaches them (section 4.4): down the child pointers from the dense
// levels to the base node, then along forward pointers. The kernel declares `first_child`, `neighbours`,
// `leaf_bits` and `block_starts`.
#import shared/corners.wgsl

// Whether `neighbours` holds the paper's three pointers a node, or three a block.
override NODE_POINTERS: bool = false;

// Index of node `key` of a level from the dense one down; NO_BLOCK where the way ends above it.
fn descend(level: u32, key: u32) -> u32 {
    let first = octree.levels[octree.dense_level].first_node;
    var node = first + (key >> (3u * (level - octree.dense_level)));
    for (var l = octree.dense_level + 1u; l <= level; l += 1u) {
        let child = first_child[node];
        if child == 0u {
            return NO_BLOCK;
        }
        node = child + ((key >> (3u * (level - l))) & 7u);
    }
    return node;
}

// Index of the sparse node ahead along an axis.
fn hop(node: u32, axis: u32) -> u32 {
    if node == NO_BLOCK {
        return NO_BLOCK;
    }
    let sparse = node - octree.dense_node_count;
    if NODE_POINTERS {
        return neighbours[3u * sparse + axis];
    }
    let bit = 1u << axis;
    if (sparse & bit) == 0u {
        return node + bit;
    }
    let block = neighbours[3u * (sparse >> 3u) + axis];
    if block == NO_BLOCK {
        return NO_BLOCK;
    }
    return octree.dense_node_count + 8u * block + ((sparse & 7u) & ~bit);
}

// The block of a sparse node by its index.
fn linked_block(level: u32, key: u32, node: u32) -> BlockLight {
    if node == NO_BLOCK {
        return NO_LIGHT;
    }
    var children = 0u;
    if level == octree.depth {
        children = leaf_mask(key >> 3u);
        if children == 0u {
            return NO_LIGHT;
        }
    }
    return block_light(level, (node - octree.dense_node_count) >> 3u, children);
}

fn linked_entry(level: u32, node: vec3<i32>) -> u32 {
    let key = morton_key(vec3<u32>(node));
    if level <= octree.dense_level {
        return octree.levels[level].first_node + key;
    }
    return entry_in(linked_block(level, key, descend(level, key)), key);
}

// With a pointer a node, every corner is hopped to, as in the paper; with one a block, every block.
fn linked_corners(level: u32, base: vec3<i32>) -> Corners {
    if level <= octree.dense_level {
        return dense_corners(level, base);
    }
    let way = way_from(base, i32(1u << level));
    var corners = no_corners();
    var nodes: array<u32, 8>;
    nodes[0] = descend(level, key_after(way, 0u));
    // Without the first node none of the eight is occupied: it would be their dummy.
    if nodes[0] == NO_BLOCK {
        return corners;
    }
    var blocks_after: array<BlockLight, 8>;
    for (var hops = 0u; hops < 8u; hops += 1u) {
        if (hops & way.closed) != 0u {
            continue;
        }
        let is_new_block = (hops & ~way.odd) == 0u;
        if hops != 0u && (NODE_POINTERS || is_new_block) {
            nodes[hops] = hop(nodes[hops & (hops - 1u)], firstTrailingBit(hops));
        }
        let key = key_after(way, hops);
        if is_new_block {
            blocks_after[hops] = linked_block(level, key, nodes[hops]);
        }
        corners.entries[hops | way.below] = entry_in(blocks_after[hops & way.odd], key);
    }
    return corners;
}
