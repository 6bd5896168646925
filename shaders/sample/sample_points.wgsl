// Samples an array of points in place: (x, y, z, level or width in cells) becomes (radiance · α, α).
// Sampling by itself, for tests and for timing its variants.
#import shared/threads.wgsl
#import shared/look_up.wgsl

struct PointParams {
    // Unit length; matters under directional opacity.
    direction: vec3<f32>,
    pad: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: PointParams;
@group(0) @binding(2) var<storage, read> blocks: array<u32>;
@group(0) @binding(3) var<storage, read> ranks: array<u32>;
@group(0) @binding(4) var<storage, read> first_child: array<u32>;
@group(0) @binding(5) var<storage, read> neighbours: array<u32>;
@group(0) @binding(6) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(7) var<storage, read> block_starts: array<u32>;
@group(0) @binding(8) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> points: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let p = points[thread];
    points[thread] = sample_by_filter(p.w, p.xyz, params.direction);
}
