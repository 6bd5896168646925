// Fills the leaves: a thread a block (2³ leaves) gathers the voxels that reach it, with exact integer
// sums in registers, and writes each occupied leaf once; the first averaging step is fused in.
// No atomics on payload, nothing to clear. Blocks with too many voxels for one thread are listed for
// gather_heavy. (The paper scatters with a moving average, section 4.3; the sums here are order-free.)
#import shared/threads.wgsl
#import shared/gather_block.wgsl
#import shared/leaf_block.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> blocks: array<u32>;
@group(0) @binding(2) var<storage, read> ranks: array<u32>;
@group(0) @binding(3) var<storage, read> block_keys: array<u32>;
@group(0) @binding(4) var<storage, read> block_starts: array<u32>;
@group(0) @binding(5) var<storage, read> sorted_voxels: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> leaves: array<u32>;
@group(0) @binding(7) var<storage, read_write> nodes: array<vec4<u32>>;
// Word 0: how many; then leaf block numbers.
@group(0) @binding(8) var<storage, read_write> heavy_blocks: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= min(threads.end, octree.leaf_block_count) {
        return;
    }
    let key = leaf_block_key(block);
    let block_cell = vec3<i32>(morton_cell(key));
    var l0 = empty_leaf(); var l1 = empty_leaf(); var l2 = empty_leaf(); var l3 = empty_leaf();
    var l4 = empty_leaf(); var l5 = empty_leaf(); var l6 = empty_leaf(); var l7 = empty_leaf();
    // One walk over all sources, so that neighbouring threads wait for the longest walk, not for the
    // longest range of each source in turn.
    var ranges: array<vec2<u32>, 8>;
    var fragments = 0u;
    var sources = 0u;
    for (var source = 0u; source < source_count(); source += 1u) {
        let range = source_range(block_cell, source);
        if range.x < range.y {
            ranges[sources] = range;
            sources += 1u;
            fragments += range.y - range.x;
        }
    }
    if fragments <= MAX_FRAGMENTS {
        var range = vec2<u32>(0u);
        for (var walked = 0u; walked < fragments; walked += 1u) {
            if range.x == range.y {
                sources -= 1u;
                range = ranges[sources];
            }
            let voxel = sorted_voxels[range.x];
            range.x += 1u;
            let w = block_weights(voxel.xy, block_cell);
            if (w.x.x | w.x.y) == 0u || (w.y.x | w.y.y) == 0u || (w.z.x | w.z.y) == 0u {
                continue;
            }
            let color = albedo_units(voxel.w);
            let normal = vec4<u32>(unpack_biased(voxel.z), 1u);
            let gap = uncovered(voxel.w);
            let xy = vec4<u32>(w.x * w.y.x, w.x * w.y.y);
            l0 = add_fragment(l0, covered_weight(xy.x * w.z.x, gap), color, normal);
            l1 = add_fragment(l1, covered_weight(xy.y * w.z.x, gap), color, normal);
            l2 = add_fragment(l2, covered_weight(xy.z * w.z.x, gap), color, normal);
            l3 = add_fragment(l3, covered_weight(xy.w * w.z.x, gap), color, normal);
            l4 = add_fragment(l4, covered_weight(xy.x * w.z.y, gap), color, normal);
            l5 = add_fragment(l5, covered_weight(xy.y * w.z.y, gap), color, normal);
            l6 = add_fragment(l6, covered_weight(xy.z * w.z.y, gap), color, normal);
            l7 = add_fragment(l7, covered_weight(xy.w * w.z.y, gap), color, normal);
        }
    }
    if fragments > MAX_FRAGMENTS {
        heavy_blocks_push(block);
        return;
    }
    var writer = begin_block(block);
    writer = write_leaf(writer, resolve_leaf(l0));
    writer = write_leaf(writer, resolve_leaf(l1));
    writer = write_leaf(writer, resolve_leaf(l2));
    writer = write_leaf(writer, resolve_leaf(l3));
    writer = write_leaf(writer, resolve_leaf(l4));
    writer = write_leaf(writer, resolve_leaf(l5));
    writer = write_leaf(writer, resolve_leaf(l6));
    writer = write_leaf(writer, resolve_leaf(l7));
    finish_block(writer, key);
}

fn heavy_blocks_push(block: u32) {
    let place = atomicAdd(&heavy_blocks[0], 1u);
    atomicStore(&heavy_blocks[1u + place], block);
}
