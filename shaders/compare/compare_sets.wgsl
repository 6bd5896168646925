// Compares two sets of leaves, bit by bit: what transformation missed (holes) and what it added
// (spill) against the exact voxelization of the posed mesh. A thread a word.
#import shared/threads.wgsl
#import constants

@group(0) @binding(0) var<storage, read> moved: array<u32>;
@group(0) @binding(1) var<storage, read> exact: array<u32>;
// Holes, spill, cells in both.
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let word = thread_index(id, groups);
    if word >= threads.end {
        return;
    }
    let m = moved[word];
    let e = exact[word];
    if (m | e) == 0u {
        return;
    }
    atomicAdd(&counts[0], countOneBits(e & ~m));
    atomicAdd(&counts[1], countOneBits(m & ~e));
    atomicAdd(&counts[2], countOneBits(m & e));
}
