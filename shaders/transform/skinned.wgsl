// Moves the voxels of skinned objects: the matrices of up to four joints, blended by integer
// weights that sum to 255 (section 3.2). In and out as for rigid objects, and the voxels' joints.
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
// Three words a voxel: joints 0 and 1, joints 2 and 3, four weights.
@group(0) @binding(7) var<storage, read> cache_joints: array<u32>;

override WORKGROUP_SIZE: u32 = 64u;

// A joint of weight zero is not read: its matrix may be anything.
fn add_joint(sum: Matrix3x4, joint: u32, weight: u32) -> Matrix3x4 {
    if weight == 0u {
        return sum;
    }
    let m = matrices[joint];
    let w = f32(weight) / 255.0;
    return Matrix3x4(array(sum.rows[0] + w * m.rows[0], sum.rows[1] + w * m.rows[1], sum.rows[2] + w * m.rows[2]));
}

fn blended_matrix(first_matrix: u32, first_word: u32) -> Matrix3x4 {
    let low = cache_joints[first_word];
    let high = cache_joints[first_word + 1u];
    let weights = cache_joints[first_word + 2u];
    if weights == 255u {
        return matrices[first_matrix + (low & 0xffffu)];
    }
    var sum = Matrix3x4();
    sum = add_joint(sum, first_matrix + (low & 0xffffu), weights & 0xffu);
    sum = add_joint(sum, first_matrix + (low >> 16u), (weights >> 8u) & 0xffu);
    sum = add_joint(sum, first_matrix + (high & 0xffffu), (weights >> 16u) & 0xffu);
    sum = add_joint(sum, first_matrix + (high >> 16u), weights >> 24u);
    return sum;
}

// Joints of scale zero leave nothing of a voxel but a place.
fn vanishes(m: Matrix3x4) -> bool {
    return all(m.rows[0].xyz == vec3<f32>(0.0)) && all(m.rows[1].xyz == vec3<f32>(0.0)) && all(m.rows[2].xyz == vec3<f32>(0.0));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = thread_index(id, groups);
    if index >= threads.end {
        return;
    }
    let thread = params.first_thread + index;
    let item = work_item(thread);
    let part = parts[item.part];
    let local = thread - item.first_thread;
    let voxel = cache_voxels[item.first_voxel + local];
    // Joints are stored for skinned caches only, so their voxels are numbered apart.
    let first_word = 3u * (item.first_voxel + local - part.joints_skew);
    let matrix = blended_matrix(part.first_matrix, first_word);
    if vanishes(matrix) {
        world_voxels[slot_of(item, thread)] = vec4<u32>(OUTSIDE);
        return;
    }
    world_voxels[slot_of(item, thread)] = move_voxel(voxel, part.origin, matrix);
}
