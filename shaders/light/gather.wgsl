// Irradiance of leaves from cones over their hemispheres: of the sky, added to what is there, or of
// what other leaves send back (a further bounce), stored. A thread a leaf block. Irradiance is π times
// the mean over cosine-weighted cones. Leaves whose normals cancel look both ways, each with half weight.
#import shared/threads.wgsl
#import shared/corners_ranked.wgsl
#import shared/leaf_mask.wgsl
#import shared/leaf_block.wgsl
#import shared/cone.wgsl
#import shared/cone_set.wgsl
#import shared/packing.wgsl

struct ConeParams {
    // Radiance behind all that is in the grid, nits.
    sky: vec3<f32>,
    // Cones over a hemisphere.
    count: u32,
    shape: ConeShape,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> cone: ConeParams;
@group(0) @binding(2) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(3) var<storage, read> blocks: array<u32>;
@group(0) @binding(4) var<storage, read> ranks: array<u32>;
@group(0) @binding(5) var<storage, read> block_starts: array<u32>;
@group(0) @binding(6) var<storage, read> block_keys: array<u32>;
@group(0) @binding(7) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read> leaves: array<u32>;
// 3 f32 an occupied leaf, lux.
@group(0) @binding(9) var<storage, read_write> irradiance: array<f32>;

override WORKGROUP_SIZE: u32 = 64u;
// Of the sky, or of a bounce.
override SKY: bool = false;

fn entry_of(level: u32, node: vec3<i32>) -> u32 {
    return ranked_entry(level, node);
}

fn corners_of(level: u32, base: vec3<i32>) -> Corners {
    return ranked_corners(level, base);
}

// Mean radiance over the hemisphere around n, weighted by the cosine.
fn mean_radiance(center: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    let basis = basis_of(n);
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < cone.count; i += 1u) {
        let direction = basis * cosine_direction(i, cone.count);
        let seen = trace_cone(cone.shape, 0.0, center + cone.shape.start_cells * n, direction);
        sum += select(seen.radiance, seen.through * cone.sky, SKY);
    }
    return sum / f32(cone.count);
}

fn leaf_irradiance(key: u32, slot: u32) -> vec3<f32> {
    let center = vec3<f32>(morton_cell(key)) + 0.5;
    let normal = unpack_normal(leaves[3u * slot + 2u]);
    let square = dot(normal, normal);
    if square < SHORT_NORMAL * SHORT_NORMAL {
        let up = vec3<f32>(0.0, 0.0, 1.0);
        return PI * 0.5 * (mean_radiance(center, up) + mean_radiance(center, -up));
    }
    return PI * mean_radiance(center, normal * inverseSqrt(square));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= min(threads.end, octree.leaf_block_count) {
        return;
    }
    let key = leaf_block_key(block);
    var children = leaf_mask(key);
    var slot = block_starts[2u * block + 1u];
    while children != 0u {
        let arriving = leaf_irradiance(8u * key + firstTrailingBit(children), slot);
        for (var channel = 0u; channel < 3u; channel += 1u) {
            let place = 3u * slot + channel;
            irradiance[place] = arriving[channel] + select(0.0, irradiance[place], SKY);
        }
        children &= children - 1u;
        slot += 1u;
    }
}
