// Gives each leaf the object that put the largest weight of one voxel there, for colouring by object
// only. Largest by atomicMax of (weight, ~object): the same in any order, the smaller number on ties.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import shared/split.wgsl
#import shared/leaf_slot.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> work_hints: array<u32>;
@group(0) @binding(3) var<storage, read> world_voxels: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> blocks: array<u32>;
@group(0) @binding(5) var<storage, read> ranks: array<u32>;
@group(0) @binding(6) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(7) var<storage, read> block_starts: array<u32>;
// One word a leaf: weight >> 9 (16 bits) above 0xffff − object.
@group(0) @binding(8) var<storage, read_write> leaf_objects: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;
override SPLIT: bool = true;

fn claim(cell: vec3<i32>, weight: u32, object: u32) {
    if weight != 0u && inside_grid(cell) {
        let slot = leaf_slot(morton_key(vec3<u32>(cell)));
        atomicMax(&leaf_objects[slot], ((weight >> 9u) << 16u) | (0xffffu - (object & 0xffffu)));
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end || octree.leaf_block_count == 0u {
        return;
    }
    let item = work_item(thread);
    let voxel = world_voxels[slot_of(item, thread)];
    if is_nowhere(voxel) {
        return;
    }
    let q = unpack_q(voxel.xy);
    let object = object_of(item, thread);
    if !SPLIT {
        claim(nearest_cell(q), FULL_WEIGHT, object);
        return;
    }
    for (var corner = 0u; corner < 8u; corner += 1u) {
        let offset = corner_offset(corner);
        claim(base_cell(q) + vec3<i32>(offset), split_weight(fraction(q), offset), object);
    }
}
