// Two sets of leaves in one picture: cells of both, of the exact set alone (holes) and of the moved
// set alone (spill), each in its colour and alpha. In: both sets' masks, a view. Out: as march.
#import shared/march.wgsl

struct GhostColors {
    // Linear colour and alpha of a visited cell.
    both: vec4<f32>,
    holes: vec4<f32>,
    spill: vec4<f32>,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> ghost: GhostColors;
@group(0) @binding(3) var<storage, read> moved_bits: array<u32>;
@group(0) @binding(4) var<storage, read> moved_occupied: array<u32>;
@group(0) @binding(5) var<storage, read> exact_bits: array<u32>;
@group(0) @binding(6) var<storage, read> exact_occupied: array<u32>;
@group(0) @binding(7) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(8) var depth: texture_storage_2d<r32float, write>;

override WORKGROUP_SIZE: u32 = 64u;

// Bit 0: the moved set, bit 1: the exact set.
fn sets_at(level: u32, key: u32) -> u32 {
    let bit = key & 31u;
    if level == octree.depth {
        let word = key >> 5u;
        return ((moved_bits[word] >> bit) & 1u) | (((exact_bits[word] >> bit) & 1u) << 1u);
    }
    let word = octree.levels[level].occupied_word + (key >> 5u);
    return ((moved_occupied[word] >> bit) & 1u) | (((exact_occupied[word] >> bit) & 1u) << 1u);
}

fn node_occupied(level: u32, key: u32) -> bool {
    return sets_at(level, key) != 0u;
}

fn ghost_color(sets: u32) -> vec4<f32> {
    switch sets {
        case 1u: { return ghost.spill; }
        case 2u: { return ghost.holes; }
        default: { return ghost.both; }
    }
}

fn seen(key: u32, ray: Ray, walk: Walk) -> vec4<f32> {
    let color = ghost_color(sets_at(octree.depth, key));
    return vec4<f32>(headlight(color.rgb, face_normal(ray, walk.entered), ray.direction), color.a);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if pixel.is_there {
        show(pixel.at);
    }
}
