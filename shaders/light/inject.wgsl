// Writes each occupied leaf's light (section 4.3): albedo/π · irradiance + emission, times its opacity.
// With IRRADIANCE, the irradiance itself, for the view of it. A thread a leaf.
#import shared/threads.wgsl
#import shared/octree.wgsl
#import shared/albedo.wgsl

struct InjectParams {
    // Of leaf_emission's 1, nits.
    emission_nits: f32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: InjectParams;
@group(0) @binding(2) var<storage, read> leaves: array<u32>;
// Three numbers a leaf each: of the lights and the sky, of bounces, and what the leaf emits.
@group(0) @binding(3) var<storage, read> direct: array<f32>;
@group(0) @binding(4) var<storage, read> gathered: array<f32>;
@group(0) @binding(5) var<storage, read> leaf_emission: array<f32>;
// Inner nodes, then leaves: light times opacity, opacity.
@group(0) @binding(6) var<storage, read_write> light: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;
override GATHERED: bool = false;
override EMISSION: bool = false;
override IRRADIANCE: bool = false;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let slot = thread_index(id, groups);
    if slot >= min(threads.end, octree.leaf_count) {
        return;
    }
    let opacity = f32(leaves[3u * slot]) / f32(FULL_WEIGHT);
    var arriving = vec3<f32>(direct[3u * slot], direct[3u * slot + 1u], direct[3u * slot + 2u]);
    if GATHERED {
        arriving += vec3<f32>(gathered[3u * slot], gathered[3u * slot + 1u], gathered[3u * slot + 2u]);
    }
    var leaving = arriving;
    if !IRRADIANCE {
        leaving = unpack_albedo(leaves[3u * slot + 1u]) * INVERSE_PI * arriving;
        if EMISSION {
            let emitted = vec3<f32>(leaf_emission[3u * slot], leaf_emission[3u * slot + 1u], leaf_emission[3u * slot + 2u]);
            leaving += params.emission_nits * emitted;
        }
    }
    light[octree.inner_node_count + slot] = vec4<f32>(leaving * opacity, opacity);
}
