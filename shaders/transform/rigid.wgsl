// Moves the voxels of rigid objects (section 4.2, Eqs. 1 and 2 and the object's transform as one
// f64-composed matrix). In: cache voxels, parts, matrices. Out: world voxels in their slots.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import shared/move_voxel.wgsl

@group(0) @binding(0) var<uniform> params: TransformParams;
@group(0) @binding(1) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> work_hints: array<u32>;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read> matrices: array<Matrix3x4>;
@group(0) @binding(5) var<storage, read> cache_voxels: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read_write> world_voxels: array<vec4<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = thread_index(id, groups);
    if index >= threads.end {
        return;
    }
    let thread = params.first_thread + index;
    let item = work_item(thread);
    let part = parts[item.part];
    let voxel = cache_voxels[item.first_voxel + thread - item.first_thread];
    world_voxels[slot_of(item, thread)] = move_voxel(voxel, part.origin, matrices[part.first_matrix]);
}
