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

// `light_entry` of a node by its index.
fn linked_light_entry(level: u32, key: u32, node: u32) -> u32 {
    if node == NO_BLOCK {
        return NO_BLOCK;
    }
    return light_entry(level, key, (node - octree.dense_node_count) >> 3u);
}

fn linked_entry(level: u32, node: vec3<i32>) -> u32 {
    let key = morton_key(vec3<u32>(node));
    if level <= octree.dense_level {
        return octree.levels[level].first_node + key;
    }
    return linked_light_entry(level, key, descend(level, key));
}

// A base of −1 is clamped: the way starts at the node that is its corner ahead.
fn linked_corners(level: u32, base: vec3<i32>) -> Corners {
    let cells = i32(1u << level);
    if !reaches_level(base, cells) {
        return no_corners();
    }
    if level <= octree.dense_level {
        return dense_corners(level, base);
    }
    let start = max(base, vec3<i32>(0));
    let below = axis_bits(base < vec3<i32>(0));
    var corners = no_corners();
    var nodes: array<u32, 8>;
    // Bit by axis: the hops from the start.
    for (var hops = 0u; hops < 8u; hops += 1u) {
        if (hops & below) != 0u {
            continue;
        }
        if hops == 0u {
            nodes[0] = descend(level, morton_key(vec3<u32>(start)));
        } else {
            nodes[hops] = hop(nodes[hops & (hops - 1u)], firstTrailingBit(hops));
        }
        let key = morton_key(vec3<u32>(start) + corner_offset(hops));
        corners.entries[hops | below] = linked_light_entry(level, key, nodes[hops]);
    }
    return corners;
}
