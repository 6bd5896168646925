// Adds one light's irradiance to every occupied leaf, once a leaf: strength · cosine · visibility, and
// distance, range and spot cone by KHR_lights_punctual. In: the leaves, a light, a shadow map or the
// octree's masks. A thread a leaf block.
#import shared/threads.wgsl
#import shared/occupied_nodes.wgsl
#import shared/leaf_mask.wgsl
#import shared/leaf_slot.wgsl
#import shared/transmittance.wgsl
#import shared/packing.wgsl
#import shared/ray_walk.wgsl
#import shared/empty_space.wgsl
#import shared/shadow_map.wgsl

struct LightParams {
    // Cells from the grid's corner.
    position: vec3<f32>,
    // LIGHT_*.
    kind: u32,
    // The way it shines, unit length.
    direction: vec3<f32>,
    // Beyond it there is no light; 0: no such place. Cells.
    range_cells: f32,
    // Lux; for point and spot lights candela over the squared span, so that distances are cells.
    strength: vec3<f32>,
    // How far above its surface a leaf looks for what hides the light.
    offset_cells: f32,
    // Spot: attenuation is (cosine · scale + offset)², clamped.
    angle_scale: f32,
    angle_offset: f32,
    pad: vec2<u32>,
}

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

fn leaf_occupancy(key: u32) -> f32 {
    return f32(leaves[3u * leaf_slot(key)]) / f32(FULL_WEIGHT);
}

// Share of the light that comes through the leaves between `from` and `end` cells along a direction:
// 1 − α a cell of length.
fn light_through(origin: vec3<f32>, direction: vec3<f32>, end: f32) -> f32 {
    let cells = grid_cells();
    let ray = ray_of(origin, direction);
    var walk = enter_lattice(ray, cells);
    var through = 1.0;
    var hint = 0u;
    for (var n = 0; n <= 3 * cells && walk.inside && walk.t < end; n += 1) {
        let key = morton_key(vec3<u32>(walk.cell));
        let level = empty_level(octree.depth, key, hint);
        hint = min(level, octree.depth);
        let shift = octree.depth - hint;
        let low = (walk.cell >> vec3<u32>(shift)) << vec3<u32>(shift);
        let exit = leave_box(ray, low, 1i << shift);
        let length = min(exit.t, end) - walk.t;
        if level > octree.depth && length > 0.0 {
            through *= transmittance(leaf_occupancy(key), length);
            if through < LEAST_LIGHT {
                return 0.0;
            }
        }
        walk = walk_on(walk, ray, low, 1i << shift, exit, cells);
    }
    return through;
}

struct Arrival {
    // Without cosine and visibility.
    irradiance: vec3<f32>,
    // Unit, to the light; how far, cells.
    direction: vec3<f32>,
    distance: f32,
}

fn arrival(p: vec3<f32>) -> Arrival {
    if light.kind == LIGHT_DIRECTIONAL {
        return Arrival(light.strength, -light.direction, NEVER);
    }
    let to_light = light.position - p;
    // A leaf is a cell wide: nearer than half a cell is as near as it gets.
    let distance = max(length(to_light), LEAST_DISTANCE_CELLS);
    let direction = to_light / distance;
    var falloff = 1.0 / (distance * distance);
    if light.range_cells > 0.0 {
        let part = distance / light.range_cells;
        falloff *= clamp(1.0 - part * part * part * part, 0.0, 1.0);
    }
    if light.kind == LIGHT_SPOT {
        let inside = clamp(dot(light.direction, -direction) * light.angle_scale + light.angle_offset, 0.0, 1.0);
        falloff *= inside * inside;
    }
    return Arrival(light.strength * falloff, direction, distance);
}

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
    let end = select(distance(light.position, start), NEVER, light.kind == LIGHT_DIRECTIONAL);
    let direction = select(normalize(light.position - start + 1e-6 * unit), to.direction, light.kind == LIGHT_DIRECTIONAL);
    return light_through(start, direction, end);
}

fn leaf_irradiance(centre: vec3<f32>, packed_normal: u32) -> vec3<f32> {
    let mean = unpack_normal(packed_normal);
    let square = dot(mean, mean);
    let r = select(min(sqrt(square), 1.0), 1.0, abs(square - 1.0) < PACKED_UNIT_SLACK);
    let unit = mean * inverseSqrt(max(square, 1e-12));
    let to = arrival(centre);
    let arriving = to.irradiance * facing(unit, r, to.direction);
    if all(arriving <= vec3<f32>(0.0)) {
        return vec3<f32>(0.0);
    }
    return arriving * visibility(centre, unit, r, to);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let block = thread_index(id, groups);
    if block >= threads.end {
        return;
    }
    let key = block_keys[octree.levels[octree.depth - 1u].first_block + block];
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
