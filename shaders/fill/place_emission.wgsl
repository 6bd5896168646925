// Emission of the sorted world voxels, beside `fill/place`: only where something in the scene emits.
// Says of each leaf block whether any of its voxels does. In: emission of the caches, in units of the
// brightest over EMISSION_MAX, and the places that counting has found.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import shared/part.wgsl

@group(0) @binding(0) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(1) var<storage, read> work_hints: array<u32>;
@group(0) @binding(2) var<storage, read> parts: array<Part>;
@group(0) @binding(3) var<storage, read> cache_emission: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> places: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read> block_starts: array<u32>;
@group(0) @binding(6) var<storage, read_write> sorted_emission: array<vec2<u32>>;
// A word a leaf block: 1 where it emits.
@group(0) @binding(7) var<storage, read_write> emitting_blocks: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let place = places[thread];
    if place.x == NO_BLOCK {
        return;
    }
    let item = work_item(thread);
    let skew = parts[item.part].emission_skew;
    var emission = vec2<u32>(0u);
    if skew != NO_BLOCK {
        emission = cache_emission[item.first_voxel + thread - item.first_thread - skew];
    }
    sorted_emission[block_starts[2u * place.x] + place.y] = emission;
    if any(emission != vec2<u32>(0u)) {
        atomicStore(&emitting_blocks[place.x], 1u);
    }
}
