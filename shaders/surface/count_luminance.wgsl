// Luminances of what is shown, counted for an exposure: thread t takes every pixel t + k·THREADS. A bin is what
// the upper bits of an f32 tell apart: LUMINANCE_BINS_A_STOP bins from each power of two to the next. Black pixels
// and those without a surface do not count. `counts` is cleared before.
#import shared/threads.wgsl
#import constants

struct CountParams {
    pixels: u32,
}

@group(0) @binding(0) var<uniform> params: CountParams;
@group(0) @binding(1) var<storage, read> shown: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    for (var i = thread; i < params.pixels; i += COUNT_THREADS) {
        let seen = shown[i];
        let luminance = dot(seen.rgb, vec3<f32>(LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE));
        if seen.a > 0.0 && luminance > 0.0 {
            atomicAdd(&counts[min(bitcast<u32>(luminance) >> LUMINANCE_BIN_SHIFT, LUMINANCE_BINS - 1u)], 1u);
        }
    }
}
