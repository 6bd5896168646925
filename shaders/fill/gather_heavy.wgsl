// Fills the leaf blocks that hold too many voxels for one thread: a workgroup a block, each thread
// sums up to MAX_FRAGMENTS voxels at a time, the workgroup adds up in 64 bits. Same result as gather
// would give with wider sums, in any order.
#import shared/gather_block.wgsl
#import shared/leaf_block.wgsl
#import shared/wide.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> blocks: array<u32>;
@group(0) @binding(2) var<storage, read> ranks: array<u32>;
@group(0) @binding(3) var<storage, read> block_keys: array<u32>;
@group(0) @binding(4) var<storage, read> block_starts: array<u32>;
@group(0) @binding(5) var<storage, read> sorted_voxels: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> leaves: array<u32>;
@group(0) @binding(7) var<storage, read_write> nodes: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read> heavy_blocks: array<u32>;

const CHANNELS: u32 = 7u;
const GROUP_THREADS: u32 = 64u;

// Sums of 8 leaves: red, green, blue, normal, weight; low and high word each.
var<workgroup> totals: array<atomic<u32>, 112>;
var<workgroup> heavy_count: u32;

fn add_total(leaf: u32, channel: u32, sum: vec2<u32>) {
    let index = 2u * (leaf * CHANNELS + channel);
    let before = atomicAdd(&totals[index], sum.x);
    atomicAdd(&totals[index + 1u], sum.y + select(0u, 1u, before + sum.x < before));
}

fn add_leaf(leaf: u32, sum: LeafSum) {
    for (var channel = 0u; channel < 3u; channel += 1u) {
        add_total(leaf, channel, color_sum(sum, channel));
    }
    for (var channel = 0u; channel < 4u; channel += 1u) {
        add_total(leaf, 3u + channel, normal_sum(sum, channel));
    }
}

// One leaf's share of up to MAX_FRAGMENTS voxels of a range, GROUP_THREADS apart.
fn sum_leaf(first: u32, end: u32, leaf: u32, block_cell: vec3<i32>) -> LeafSum {
    var sum = empty_leaf();
    let offset = corner_offset(leaf);
    for (var i = first; i < end; i += GROUP_THREADS) {
        let w = block_weights(sorted_voxels[i].xy, block_cell);
        let packed = sorted_voxels[i].zw;
        let weight = covered_weight(w.x[offset.x] * w.y[offset.y] * w.z[offset.z], uncovered(packed.y));
        sum = add_fragment(sum, weight, albedo_units(packed.y), vec4<u32>(unpack_biased(packed.x), 1u));
    }
    return sum;
}

fn gather_source(range: vec2<u32>, local: u32, block_cell: vec3<i32>) {
    let stride = GROUP_THREADS * MAX_FRAGMENTS;
    for (var first = range.x; first < range.y; first += stride) {
        let end = min(range.y, first + stride);
        for (var leaf = 0u; leaf < 8u; leaf += 1u) {
            add_leaf(leaf, sum_leaf(first + local, end, leaf, block_cell));
        }
    }
}

fn total(leaf: u32, channel: u32) -> vec2<u32> {
    let index = 2u * (leaf * CHANNELS + channel);
    return vec2<u32>(atomicLoad(&totals[index]), atomicLoad(&totals[index + 1u]));
}

fn resolve_total(leaf: u32) -> Leaf {
    let color = array<vec2<u32>, 3>(total(leaf, 0u), total(leaf, 1u), total(leaf, 2u));
    let normal = array<vec2<u32>, 3>(total(leaf, 3u), total(leaf, 4u), total(leaf, 5u));
    return leaf_of(total(leaf, 6u), color, normal);
}

fn write_block(block: u32, key: u32) {
    var writer = begin_block(block);
    for (var leaf = 0u; leaf < 8u; leaf += 1u) {
        writer = write_leaf(writer, resolve_total(leaf));
    }
    finish_block(writer, key);
}

@compute @workgroup_size(GROUP_THREADS)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    if local == 0u {
        heavy_count = heavy_blocks[0];
    }
    let count = workgroupUniformLoad(&heavy_count);
    for (var i = group.x; i < count; i += groups.x) {
        let block = heavy_blocks[1u + i];
        let key = leaf_block_key(block);
        for (var word = local; word < 16u * CHANNELS; word += GROUP_THREADS) {
            atomicStore(&totals[word], 0u);
        }
        workgroupBarrier();
        for (var source = 0u; source < source_count(); source += 1u) {
            let cell = vec3<i32>(morton_cell(key));
            gather_source(source_range(cell, source), local, cell);
        }
        workgroupBarrier();
        if local == 0u {
            write_block(block, key);
        }
        workgroupBarrier();
    }
}
