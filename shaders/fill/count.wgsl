// First half of the counting sort by base block (2³ cells): each voxel's block and its place among
// the block's voxels. The places differ between runs; every sum over a block does not.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import shared/world_voxel.wgsl
#import shared/block_rank.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> work_hints: array<u32>;
@group(0) @binding(3) var<storage, read> world_voxels: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> blocks: array<u32>;
@group(0) @binding(5) var<storage, read> ranks: array<u32>;
// Voxels and leaves of each leaf block.
@group(0) @binding(6) var<storage, read_write> block_counts: array<atomic<u32>>;
// A voxel's leaf block (NO_BLOCK: outside) and its place in it.
@group(0) @binding(7) var<storage, read_write> places: array<vec2<u32>>;

override WORKGROUP_SIZE: u32 = 64u;
override SPLIT: bool = true;

// The cell whose block sorts the voxel. A base in the guard layer sorts with its forward
// neighbour, which is the one it reaches.
fn sorting_cell(q: vec3<i32>) -> vec3<i32> {
    if SPLIT {
        return max(base_cell(q), vec3<i32>(0));
    }
    return nearest_cell(q);
}

fn sorting_block(voxel: vec4<u32>) -> u32 {
    if is_nowhere(voxel) || octree.leaf_block_count == 0u {
        return NO_BLOCK;
    }
    let cell = sorting_cell(unpack_q(voxel.xy));
    if !inside_grid(cell) {
        return NO_BLOCK;
    }
    return leaf_block_rank(morton_key(vec3<u32>(cell)) >> 3u);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let block = sorting_block(world_voxels[slot_of(work_item(thread), thread)]);
    var place = 0u;
    if block != NO_BLOCK {
        place = atomicAdd(&block_counts[2u * block], 1u);
    }
    places[thread] = vec2<u32>(block, place);
}
