// Emission of the occupied leaves: the mean over the voxels that reach a leaf, by weight, from exact
// integer sums. A thread a leaf block; blocks whose voxels all are dark leave their leaves as cleared.
#import shared/threads.wgsl
#import shared/block_sources.wgsl
#import shared/leaf_block.wgsl
#import shared/emission.wgsl
#import shared/wide.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> blocks: array<u32>;
@group(0) @binding(2) var<storage, read> ranks: array<u32>;
@group(0) @binding(3) var<storage, read> block_keys: array<u32>;
@group(0) @binding(4) var<storage, read> block_starts: array<u32>;
@group(0) @binding(5) var<storage, read> sorted_voxels: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> sorted_emission: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read> emitting_blocks: array<u32>;
// Three numbers a leaf, 1 is the brightest voxel of the scene.
@group(0) @binding(8) var<storage, read_write> leaf_emission: array<f32>;

override WORKGROUP_SIZE: u32 = 64u;

struct EmissionSum {
    weight: vec2<u32>,
    red: vec2<u32>,
    green: vec2<u32>,
    blue: vec2<u32>,
}

// What reaches leaf number `leaf` of the block from one range of sorted voxels.
fn add_range(before: EmissionSum, range: vec2<u32>, leaf: u32, block_cell: vec3<i32>) -> EmissionSum {
    let offset = corner_offset(leaf);
    var sum = before;
    for (var i = range.x; i < range.y; i += 1u) {
        let voxel = sorted_voxels[i];
        let w = block_weights(voxel.xy, block_cell);
        let weight = covered_weight(w.x[offset.x] * w.y[offset.y] * w.z[offset.z], uncovered(voxel.w));
        if weight != 0u {
            let emission = unpack_emission(sorted_emission[i]);
            sum.weight = wide_add(sum.weight, vec2<u32>(weight, 0u));
            sum.red = add_product(sum.red, weight, emission.x);
            sum.green = add_product(sum.green, weight, emission.y);
            sum.blue = add_product(sum.blue, weight, emission.z);
        }
    }
    return sum;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= min(threads.end, octree.leaf_block_count) {
        return;
    }
    let block_cell = vec3<i32>(morton_cell(leaf_block_key(block)));
    // Looked up once for all leaves.
    var ranges: array<vec2<u32>, 8>;
    var emits = false;
    for (var source = 0u; source < source_count(); source += 1u) {
        let from_block = source_block(block_cell, source);
        if from_block != NO_BLOCK {
            ranges[source] = block_range(from_block);
            emits = emits || emitting_blocks[from_block] != 0u;
        }
    }
    if !emits {
        return;
    }
    var slot = block_starts[2u * block + 1u];
    for (var leaf = 0u; leaf < 8u; leaf += 1u) {
        var sum = EmissionSum(vec2<u32>(0u), vec2<u32>(0u), vec2<u32>(0u), vec2<u32>(0u));
        for (var source = 0u; source < source_count(); source += 1u) {
            sum = add_range(sum, ranges[source], leaf, block_cell);
        }
        if any(sum.weight != vec2<u32>(0u)) {
            let full = wide_to_float(sum.weight) * f32(EMISSION_MAX);
            leaf_emission[3u * slot] = wide_to_float(sum.red) / full;
            leaf_emission[3u * slot + 1u] = wide_to_float(sum.green) / full;
            leaf_emission[3u * slot + 2u] = wide_to_float(sum.blue) / full;
            slot += 1u;
        }
    }
}
