// One world voxel of all fragments that an object leaves in a cell, weighted by visible area: exact sums, one mean. A
// thread a fragment: the first of its object and cell in its bucket sums them all. In: shaded fragments by bucket.
// Out: world voxels, which lie wholly in their cells, in an order that differs between runs; their objects, and what
// they emit.
#import shared/threads.wgsl
#import shared/fragments.wgsl
#import shared/emission.wgsl
#import shared/albedo.wgsl
#import shared/morton.wgsl
#import shared/wide.wgsl
#import shared/world_voxel.wgsl

@group(0) @binding(0) var<uniform> room: FragmentRoom;
@group(0) @binding(1) var<uniform> counts: FragmentCounts;
@group(0) @binding(2) var<storage, read> heads: array<u32>;
@group(0) @binding(3) var<storage, read> fragments: array<u32>;
@group(0) @binding(4) var<storage, read_write> voxel_count: atomic<u32>;
@group(0) @binding(5) var<storage, read_write> world_voxels: array<vec4<u32>>;
// The hints of the work list, and the voxels' objects behind them.
@group(0) @binding(6) var<storage, read_write> voxel_objects: array<u32>;
@group(0) @binding(7) var<storage, read_write> voxel_emission: array<vec2<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

struct CellSum {
    area: vec2<u32>,
    weight: vec2<u32>,
    // Squares of roots.
    color: array<vec2<u32>, 3>,
    // Biased.
    normal: array<vec2<u32>, 3>,
    emission: array<vec2<u32>, 3>,
}

fn is_of(number: u32, key: u32, object: u32) -> bool {
    let start = fragment_start(number);
    return fragments[start] == key && fragments[start + 2u] == object;
}

// Number + 1 of the next in the bucket.
fn next_of(number: u32) -> u32 {
    return fragments[fragment_start(number) + 1u];
}

// Whether no fragment before it in its bucket is of the same cell and object.
fn is_first(number: u32, key: u32, object: u32) -> bool {
    var at = heads[bucket_word(key)];
    while at != 0u && !is_of(at - 1u, key, object) {
        at = next_of(at - 1u);
    }
    return at == number + 1u;
}

fn add_to(sum: ptr<function, CellSum>, number: u32) {
    let start = fragment_start(number);
    let word = fragments[start + 3u];
    let area = word & ((1u << AREA_BITS) - 1u);
    // Rounded, so that what is there as a whole weighs its area.
    let weight = (area * (word >> AREA_BITS) + OPACITY_ONE / 2u) / OPACITY_ONE;
    let root = unpack_position(fragments[start + 4u]);
    let normal = unpack_biased(fragments[start + 5u]);
    (*sum).area = wide_add((*sum).area, vec2<u32>(area, 0u));
    (*sum).weight = wide_add((*sum).weight, vec2<u32>(weight, 0u));
    for (var i = 0u; i < 3u; i += 1u) {
        (*sum).color[i] = add_product((*sum).color[i], weight, root[i] * root[i]);
        (*sum).normal[i] = add_product((*sum).normal[i], weight, normal[i]);
    }
    if EMITS {
        let emission = unpack_emission(vec2<u32>(fragments[start + 6u], fragments[start + 7u]));
        for (var i = 0u; i < 3u; i += 1u) {
            (*sum).emission[i] = add_product((*sum).emission[i], weight, emission[i]);
        }
    }
}

// Linear colour and coverage, coded as voxels have them.
fn color_word(sum: CellSum, weight: f32) -> u32 {
    let mean = vec3<f32>(wide_to_float(sum.color[0]), wide_to_float(sum.color[1]), wide_to_float(sum.color[2])) / weight;
    return pack4x8unorm(vec4<f32>(sqrt(mean) / f32(ALBEDO_CODE_ONE), weight / wide_to_float(sum.area)));
}

// Zero where opposed normals cancel: shorter than a step of the packing, the direction left over is noise.
fn normal_word(sum: CellSum, weight: f32) -> u32 {
    let biased = vec3<f32>(wide_to_float(sum.normal[0]), wide_to_float(sum.normal[1]), wide_to_float(sum.normal[2])) / weight;
    let mean = biased / f32(NORMAL_MAX) - 1.0;
    return pack_normal(select(vec3<f32>(0.0), mean, length(mean) * f32(NORMAL_MAX) >= 1.0));
}

fn emission_words(sum: CellSum, weight: f32) -> vec2<u32> {
    let mean = vec3<f32>(wide_to_float(sum.emission[0]), wide_to_float(sum.emission[1]), wide_to_float(sum.emission[2])) / weight;
    return pack_emission(min(vec3<u32>(mean + 0.5), vec3<u32>(EMISSION_MAX)));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let number = thread_index(id, groups);
    if number >= threads.end || number >= min(counts.fragments, room.fragments) {
        return;
    }
    let key = fragments[fragment_start(number)];
    let object = fragments[fragment_start(number) + 2u];
    if !is_first(number, key, object) {
        return;
    }
    var sum = CellSum();
    for (var at = number + 1u; at != 0u; at = next_of(at - 1u)) {
        if is_of(at - 1u, key, object) {
            add_to(&sum, at - 1u);
        }
    }
    let weight = wide_to_float(sum.weight);
    // What alpha cuts out is not there.
    if weight == 0.0 {
        return;
    }
    let voxel = atomicAdd(&voxel_count, 1u);
    if voxel >= room.voxels {
        return;
    }
    let q = vec3<i32>(morton_cell(key)) << vec3<u32>(FRACTION_BITS);
    world_voxels[voxel] = vec4<u32>(pack_q(q), normal_word(sum, weight), color_word(sum, weight));
    voxel_objects[room.hints + voxel] = object;
    if EMITS {
        voxel_emission[voxel] = emission_words(sum, weight);
    }
}
