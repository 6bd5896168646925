// The eight nodes around a point, and where their light lies. What both look-ups share: which of the
// eight are in the grid, and from a node's block to its entry of `light` (data::octree draws it).
// The kernel declares `leaf_bits` and `block_starts`.
//
// Corner j of base node b is b + (j & 1, j >> 1 & 1, j >> 2). A point is rounded down to the lattice of
// node centres, so a base may be −1: such corners have weight, but no node.
#import shared/octree.wgsl

// Entry of `light` for each corner, NO_BLOCK without one.
struct Corners {
    entries: array<u32, 8>,
}

fn no_corners() -> Corners {
    return Corners(array<u32, 8>(NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK));
}

fn corner_offset(j: u32) -> vec3<u32> {
    return (vec3<u32>(j) >> vec3<u32>(0u, 1u, 2u)) & vec3<u32>(1u);
}

// Bit by axis.
fn axis_bits(axes: vec3<bool>) -> u32 {
    let bits = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), axes);
    return bits.x | bits.y | bits.z;
}

// Whether any corner of a base lies in a level of `cells`³ nodes.
fn reaches_level(base: vec3<i32>, cells: i32) -> bool {
    return all(base >= vec3<i32>(-1)) && all(base < vec3<i32>(cells));
}

fn node_in_level(node: vec3<i32>, cells: i32) -> bool {
    return all(node >= vec3<i32>(0)) && all(node < vec3<i32>(cells));
}

// Entry of node `key` of a sparse level in block `block`; leaves have one only where occupied.
fn light_entry(level: u32, key: u32, block: u32) -> u32 {
    if block == NO_BLOCK {
        return NO_BLOCK;
    }
    if level < octree.depth {
        return octree.dense_node_count + 8u * block + (key & 7u);
    }
    let children = (leaf_bits[key >> 5u] >> (key & 24u)) & 0xffu;
    let bit = 1u << (key & 7u);
    if (children & bit) == 0u {
        return NO_BLOCK;
    }
    let leaf_block = block - octree.levels[octree.depth - 1u].first_block;
    return octree.inner_node_count + block_starts[2u * leaf_block + 1u] + countOneBits(children & (bit - 1u));
}

// Corners in a dense level.
fn dense_corners(level: u32, base: vec3<i32>) -> Corners {
    var corners = no_corners();
    for (var j = 0u; j < 8u; j += 1u) {
        let node = base + vec3<i32>(corner_offset(j));
        if node_in_level(node, i32(1u << level)) {
            corners.entries[j] = octree.levels[level].first_node + morton_key(vec3<u32>(node));
        }
    }
    return corners;
}
