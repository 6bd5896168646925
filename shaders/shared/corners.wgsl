// The eight nodes around a point, and where their light lies. What both look-ups share: which of the
// eight are in the grid, which of them share a block, and from a block to the entries of `light` of its
// nodes (data::light draws it). The kernel declares `leaf_bits` and `block_starts`.
//
// Corner j of base node b is b + (j & 1, j >> 1 & 1, j >> 2). A point is rounded down to the lattice of
// node centres, so a base may be −1: such corners have weight, but no node.
#import shared/octree.wgsl
#import shared/leaf_mask.wgsl

// Entry of `light` for each corner, NO_BLOCK without one.
struct Corners {
    entries: array<u32, 8>,
}

fn no_corners() -> Corners {
    return Corners(array<u32, 8>(NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK, NO_BLOCK));
}

// Hops from the first node in the grid to the other corners. Bits are by axis.
struct Way {
    // Key bits of the start along each axis, and of the node ahead.
    near: vec3<u32>,
    far: vec3<u32>,
    // Where the base is −1: the start is then the corner ahead.
    below: u32,
    // Where a hop leaves the grid, or the eight.
    closed: u32,
    // Where a hop leaves the block.
    odd: u32,
}

fn axis_bits(axes: vec3<bool>) -> u32 {
    let bits = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), axes);
    return bits.x | bits.y | bits.z;
}

fn axis_keys(node: vec3<u32>) -> vec3<u32> {
    return vec3<u32>(spread_bits(node.x), spread_bits(node.y) << 1u, spread_bits(node.z) << 2u);
}

// In a level of `cells`³ nodes, for a base of −1 to cells − 1.
fn way_from(base: vec3<i32>, cells: i32) -> Way {
    let start = vec3<u32>(max(base, vec3<i32>(0)));
    let below = axis_bits(base < vec3<i32>(0));
    let closed = below | axis_bits(base + 1 >= vec3<i32>(cells));
    let odd = axis_bits((start & vec3<u32>(1u)) == vec3<u32>(1u));
    return Way(axis_keys(start), axis_keys(start + 1u), below, closed, odd);
}

fn key_after(way: Way, hops: u32) -> u32 {
    let keys = select(way.near, way.far, corner_offset(hops) == vec3<u32>(1u));
    return keys.x | keys.y | keys.z;
}

// The light of a block's nodes: those of `children` have entries from `first` on, one after the other.
struct BlockLight {
    first: u32,
    children: u32,
}

const NO_LIGHT: BlockLight = BlockLight(0u, 0u);

// Of a block by its rank, for nodes of `level`; inner nodes all have entries.
fn block_light(level: u32, block: u32, children: u32) -> BlockLight {
    if level < octree.depth {
        return BlockLight(octree.dense_node_count + 8u * block, 0xffu);
    }
    let leaf_block = block - octree.levels[octree.depth - 1u].first_block;
    return BlockLight(octree.inner_node_count + block_starts[2u * leaf_block + 1u], children);
}

fn entry_in(block: BlockLight, key: u32) -> u32 {
    let bit = 1u << (key & 7u);
    return select(NO_BLOCK, block.first + countOneBits(block.children & (bit - 1u)), (block.children & bit) != 0u);
}

// Corners in a dense level, whose nodes all lie in Morton order. A key outside the grid has all bits.
fn dense_corners(level: u32, base: vec3<i32>) -> Corners {
    let last = vec3<i32>((1 << level) - 1);
    let near = select(vec3<u32>(NO_BLOCK), axis_keys(vec3<u32>(base)), base >= vec3<i32>(0));
    let far = select(vec3<u32>(NO_BLOCK), axis_keys(vec3<u32>(base + 1)), base < last);
    let first = octree.levels[level].first_node;
    var corners: Corners;
    for (var j = 0u; j < 8u; j += 1u) {
        let keys = select(near, far, corner_offset(j) == vec3<u32>(1u));
        let key = keys.x | keys.y | keys.z;
        corners.entries[j] = select(first + key, NO_BLOCK, key == NO_BLOCK);
    }
    return corners;
}
