// Shows the octree (Fig. 8): a ray a pixel blends the voxels it crosses, front to back, occupancy as
// alpha, at the leaves or any level above them. In: the octree, a view. Out: the picture,
// gamma-encoded, and the distance to where half of the light is stopped.
#import shared/albedo.wgsl
#import shared/occupied_nodes.wgsl
#import shared/leaf_slot.wgsl
#import shared/march.wgsl
#import shared/packing.wgsl
#import shared/palette.wgsl
#import shared/wide.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> palette: Palette;
@group(0) @binding(3) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(4) var<storage, read> occupied: array<u32>;
@group(0) @binding(5) var<storage, read> blocks: array<u32>;
@group(0) @binding(6) var<storage, read> ranks: array<u32>;
@group(0) @binding(7) var<storage, read> block_starts: array<u32>;
@group(0) @binding(8) var<storage, read> leaves: array<u32>;
@group(0) @binding(9) var<storage, read> nodes: array<vec4<u32>>;
// Read only when colour is by object.
@group(0) @binding(10) var<storage, read> leaf_objects: array<u32>;
@group(0) @binding(11) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(12) var depth: texture_storage_2d<r32float, write>;

override WORKGROUP_SIZE: u32 = 64u;

// What a voxel shows.
struct Voxel {
    occupancy: f32,
    color: vec3<f32>,
    normal: vec3<f32>,
}

// The colour a voxel is painted with; shading comes later.
fn painted(albedo: vec3<f32>, occupancy: f32, normal: vec3<f32>) -> vec3<f32> {
    switch view.color_by {
        case COLOR_NORMAL: { return linear_from_gamma(0.5 * normal + 0.5); }
        case COLOR_OCCUPANCY: { return palette_value(occupancy); }
        case COLOR_DARK: { return vec3<f32>(0.0); }
        case COLOR_LEVEL: { return palette_value(f32(view.level) / f32(octree.depth)); }
        default: { return albedo; }
    }
}

fn leaf_voxel(key: u32) -> Voxel {
    let slot = leaf_slot(key);
    let occupancy = f32(leaves[3u * slot]) / f32(FULL_WEIGHT);
    let normal = unpack_normal(leaves[3u * slot + 2u]);
    if view.color_by == COLOR_OBJECT {
        let object = OBJECT_MASK - (leaf_objects[slot] & OBJECT_MASK);
        return Voxel(occupancy, palette.colors[object & 255u].rgb, normal);
    }
    let albedo = unpack_albedo(leaves[3u * slot + 1u]);
    return Voxel(occupancy, painted(albedo, occupancy, normal), normal);
}

fn node_voxel(level: u32, key: u32) -> Voxel {
    let node = nodes[node_index(level, key)];
    let sum = wide_to_float(node.xy);
    let occupancy = sum / (f32(FULL_WEIGHT) * exp2(3.0 * f32(octree.depth - level)));
    let albedo = unpack_albedo(node.z);
    let normal = unpack_normal(node.w);
    return Voxel(occupancy, painted(albedo, occupancy, normal), normal);
}

fn voxel_at(key: u32) -> Voxel {
    if view.level == octree.depth {
        return leaf_voxel(key);
    }
    return node_voxel(view.level, key);
}

// Measured colours are not shaded, so that they match the legend.
fn seen(key: u32, ray: Ray, walk: Walk) -> vec4<f32> {
    let voxel = voxel_at(key);
    if view.color_by == COLOR_NORMAL || view.color_by == COLOR_OCCUPANCY {
        return vec4<f32>(voxel.color, voxel.occupancy);
    }
    let is_short = dot(voxel.normal, voxel.normal) < SHORT_NORMAL * SHORT_NORMAL;
    let normal = select(voxel.normal, face_normal(ray, walk.entered), is_short);
    return vec4<f32>(headlight(voxel.color, normal, ray.direction), voxel.occupancy);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if pixel.is_there {
        show(pixel.at);
    }
}
