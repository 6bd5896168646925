// Logarithms of what is shown, summed for an exposure: thread t takes every pixel t + k·THREADS. Out: a sum
// of log2 of luminances, and how many, a thread; black pixels and those without a surface do not count.
#import shared/threads.wgsl
#import constants

struct SumParams {
    pixels: u32,
}

@group(0) @binding(0) var<uniform> params: SumParams;
@group(0) @binding(1) var<storage, read> shown: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> sums: array<vec2<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    var sum = vec2<f32>(0.0);
    for (var i = thread; i < params.pixels; i += SUM_THREADS) {
        let seen = shown[i];
        let luminance = dot(seen.rgb, vec3<f32>(LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE));
        if seen.a > 0.0 && luminance > 0.0 {
            sum += vec2<f32>(log2(luminance), 1.0);
        }
    }
    sums[thread] = sum;
}
