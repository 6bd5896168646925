// The exposure that a picture of surfaces asks for, from the sums of `sum_luminance`: its geometric mean is shown
// as MEAN_SHOWN_AS. One workgroup.
#import constants
#import shared/picture_exposure.wgsl

const GROUP_THREADS: u32 = 64u;

@group(0) @binding(0) var<storage, read> sums: array<vec2<f32>>;
@group(0) @binding(1) var<storage, read_write> exposure: PictureExposure;

// Of each thread: log2 of luminances, and how many.
var<workgroup> parts: array<vec2<f32>, GROUP_THREADS>;

@compute @workgroup_size(GROUP_THREADS)
fn main(@builtin(local_invocation_index) local: u32) {
    var sum = vec2<f32>(0.0);
    for (var i = local; i < SUM_THREADS; i += GROUP_THREADS) {
        sum += sums[i];
    }
    parts[local] = sum;
    workgroupBarrier();
    if local != 0u {
        return;
    }
    var all = vec2<f32>(0.0);
    for (var i = 0u; i < GROUP_THREADS; i += 1u) {
        all += parts[i];
    }
    if all.y > 0.0 {
        let mean = exp2(all.x / all.y);
        exposure = PictureExposure(MEAN_SHOWN_AS / mean, mean, vec2<u32>(0u));
    } else {
        exposure = PictureExposure(1.0, 0.0, vec2<u32>(0u));
    }
}
