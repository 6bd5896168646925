// Adds one light's irradiance to every occupied leaf, once a leaf: strength · cosine · visibility, and
// distance, range and spot cone by KHR_lights_punctual. In: the leaves, a light, a shadow map or the
// octree's masks. A thread a leaf block.
#import shared/threads.wgsl
#import shared/leaf_block.wgsl
#import shared/packing.wgsl
#import shared/light.wgsl
#import shared/light_through.wgsl
#import shared/shadow_map.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> light: LightParams;
@group(0) @binding(2) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(3) var<storage, read> occupied: array<u32>;
@group(0) @binding(4) var<storage, read> blocks: array<u32>;
@group(0) @binding(5) var<storage, read> ranks: array<u32>;
@group(0) @binding(6) var<storage, read> block_keys: array<u32>;
@group(0) @binding(7) var<storage, read> block_starts: array<u32>;
@group(0) @binding(8) var<storage, read> leaves: array<u32>;
// Three numbers a leaf, lux.
@group(0) @binding(9) var<storage, read_write> irradiance: array<f32>;
@group(0) @binding(10) var<uniform> shadow: ShadowParams;
@group(0) @binding(11) var shadow_map: texture_2d_array<f32>;

override WORKGROUP_SIZE: u32 = 64u;
// SHADOWS_*.
override SHADOWS: u32 = 0u;

// Cosine at a leaf whose mean normal has length r: the part that agrees, r, faces one way; the rest
// faces every way, and an even spread of normals sees a quarter of a light. Cloth whose normals cancel
// is lit from both sides so.
fn facing(unit: vec3<f32>, r: f32, to_light: vec3<f32>) -> f32 {
    return r * max(dot(unit, to_light), 0.0) + (1.0 - r) * SPREAD_COSINE;
}

fn visibility(centre: vec3<f32>, unit: vec3<f32>, r: f32, to: Arrival) -> f32 {
    if SHADOWS == SHADOWS_OFF {
        return 1.0;
    }
    // Out of the leaf's own surface: along its normal where that faces the light, else to the light.
    let along_normal = r >= SHORT_NORMAL && dot(unit, to.direction) > 0.0;
    let start = centre + light.offset_cells * select(to.direction, unit, along_normal);
    if SHADOWS == SHADOWS_MAP {
        return lit_share(start);
    }
    return light_from(start, unit);
}

fn leaf_irradiance(centre: vec3<f32>, packed_normal: u32) -> vec3<f32> {
    let mean = unpack_normal(packed_normal);
    let square = dot(mean, mean);
    let r = select(min(sqrt(square), 1.0), 1.0, abs(square - 1.0) < PACKED_UNIT_SLACK);
    let unit = mean * inverseSqrt(max(square, 1e-12));
    // A leaf is a cell wide: nearer than half a cell is as near as it gets.
    let to = arrival(centre, LEAST_DISTANCE_CELLS);
    let arriving = to.irradiance * facing(unit, r, to.direction);
    if all(arriving <= vec3<f32>(0.0)) {
        return vec3<f32>(0.0);
    }
    return arriving * visibility(centre, unit, r, to);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= min(threads.end, octree.leaf_block_count) {
        return;
    }
    let key = leaf_block_key(block);
    let low = 2u * morton_cell(key);
    var mask = leaf_mask(key);
    var slot = block_starts[2u * block + 1u];
    while mask != 0u {
        let corner = firstTrailingBit(mask);
        let centre = vec3<f32>(low + corner_offset(corner)) + 0.5;
        let arrived = leaf_irradiance(centre, leaves[3u * slot + 2u]);
        irradiance[3u * slot] += arrived.x;
        irradiance[3u * slot + 1u] += arrived.y;
        irradiance[3u * slot + 2u] += arrived.z;
        mask &= mask - 1u;
        slot += 1u;
    }
}
