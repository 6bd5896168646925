// Second half of the counting sort: world voxels in block order.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import constants

@group(0) @binding(0) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(1) var<storage, read> work_hints: array<u32>;
@group(0) @binding(2) var<storage, read> world_voxels: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> places: array<vec2<u32>>;
// First voxel and first leaf of each leaf block.
@group(0) @binding(4) var<storage, read> block_starts: array<u32>;
@group(0) @binding(5) var<storage, read_write> sorted_voxels: array<vec4<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let place = places[thread];
    if place.x != NO_BLOCK {
        sorted_voxels[block_starts[2u * place.x] + place.y] = world_voxels[slot_of(work_item(thread), thread)];
    }
}
