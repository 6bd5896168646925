// Shows the light that the octree holds, radiance or irradiance: as `march`, coloured by a node's mean
// light times the exposure, which is set, or shows the mean of all light as MEAN_SHOWN_AS. In: the octree's
// masks, `light`, a view.
#import shared/occupied_nodes.wgsl
#import shared/leaf_slot.wgsl
#import shared/march.wgsl
#import shared/mean_light.wgsl

struct ExposureParams {
    // Shown = light · factor, unless it is automatic.
    factor: f32,
    // 1: by the mean.
    automatic: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> exposure: ExposureParams;
@group(0) @binding(3) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(4) var<storage, read> occupied: array<u32>;
@group(0) @binding(5) var<storage, read> blocks: array<u32>;
@group(0) @binding(6) var<storage, read> ranks: array<u32>;
@group(0) @binding(7) var<storage, read> block_starts: array<u32>;
@group(0) @binding(8) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(9) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(10) var depth: texture_storage_2d<r32float, write>;

override WORKGROUP_SIZE: u32 = 64u;

// Of this picture.
var<private> factor: f32;

fn exposure_factor() -> f32 {
    if exposure.automatic == 0u {
        return exposure.factor;
    }
    let mean = mean_luminance();
    if !(mean > 0.0) {
        return 1.0;
    }
    return MEAN_SHOWN_AS / mean;
}

// Where the light of an occupied node of the shown level lies.
fn light_index(key: u32) -> u32 {
    if view.level < octree.depth {
        return node_index(view.level, key);
    }
    return octree.inner_node_count + leaf_slot(key);
}

fn seen(key: u32, ray: Ray, walk: Walk) -> vec4<f32> {
    let stored = light[light_index(key)];
    return vec4<f32>(stored.xyz / stored.w * factor, stored.w);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if pixel.is_there {
        factor = exposure_factor();
        show(pixel.at);
    }
}
