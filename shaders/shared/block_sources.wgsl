// The voxels that reach a leaf block: where they lie among the sorted ones, and the weights each has in
// the block's 2³ leaves. A kernel declares `blocks`, `ranks` and `block_starts`.
#import shared/world_voxel.wgsl
#import shared/block_rank.wgsl

override SPLIT: bool = true;

// Blocks whose voxels may reach a block: itself and, under split, its backward neighbours.
fn source_count() -> u32 {
    return select(1u, 8u, SPLIT);
}

// Leaf block number `source` of those whose voxels reach the block at `block_cell` (in blocks).
fn source_block(block_cell: vec3<i32>, source: u32) -> u32 {
    let cell = block_cell - vec3<i32>(corner_offset(source));
    if any(cell < vec3<i32>(0)) {
        return NO_BLOCK;
    }
    return leaf_block_rank(morton_key(vec3<u32>(cell)));
}

// Range of a block's voxels among the sorted ones.
fn block_range(block: u32) -> vec2<u32> {
    return vec2<u32>(block_starts[2u * block], block_starts[2u * block + 2u]);
}

// The same of that source.
fn source_range(block_cell: vec3<i32>, source: u32) -> vec2<u32> {
    let block = source_block(block_cell, source);
    if block == NO_BLOCK {
        return vec2<u32>(0u);
    }
    return block_range(block);
}

// Weights along one axis in the block's two layers, for the base cell's distance from the first.
fn axis_weights(distance: i32, f: u32) -> vec2<u32> {
    switch distance {
        case -1: { return vec2<u32>(f, 0u); }
        case 0: { return vec2<u32>(FRACTION_ONE - f, f); }
        case 1: { return vec2<u32>(0u, FRACTION_ONE - f); }
        default: { return vec2<u32>(0u); }
    }
}

struct BlockWeights {
    x: vec2<u32>,
    y: vec2<u32>,
    z: vec2<u32>,
}

fn block_weights(words: vec2<u32>, block_cell: vec3<i32>) -> BlockWeights {
    let q = unpack_q(words);
    if SPLIT {
        let distance = base_cell(q) - 2 * block_cell;
        let f = fraction(q);
        return BlockWeights(axis_weights(distance.x, f.x), axis_weights(distance.y, f.y), axis_weights(distance.z, f.z));
    }
    let layer = nearest_cell(q) - 2 * block_cell;
    return BlockWeights(axis_weights(layer.x, 0u), axis_weights(layer.y, 0u), axis_weights(layer.z, 0u));
}
