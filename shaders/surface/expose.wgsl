// The exposure that a picture of surfaces asks for, from the counts of `count_luminance`: one pixel in
// LIT_TO_BRIGHTER is brighter than what is shown as BRIGHT_SHOWN_AS. One workgroup.
#import constants
#import shared/picture_exposure.wgsl

const GROUP_THREADS: u32 = 64u;

@group(0) @binding(0) var<storage, read> counts: array<u32>;
@group(0) @binding(1) var<storage, read_write> exposure: PictureExposure;

// Pixels in the bins of each thread, which lie together.
var<workgroup> parts: array<u32, GROUP_THREADS>;

// Where the bin begins.
fn luminance_of(bin: u32) -> f32 {
    return bitcast<f32>(bin << LUMINANCE_BIN_SHIFT);
}

// Luminance that `brighter` pixels and a half exceed, spread evenly over their bins.
fn exceeded_by(brighter: u32) -> f32 {
    let bins = LUMINANCE_BINS / GROUP_THREADS;
    var part = GROUP_THREADS - 1u;
    var above = 0u;
    while part > 0u && above + parts[part] <= brighter {
        above += parts[part];
        part -= 1u;
    }
    var bin = (part + 1u) * bins - 1u;
    while bin > part * bins && above + counts[bin] <= brighter {
        above += counts[bin];
        bin -= 1u;
    }
    let share = (f32(brighter - above) + 0.5) / f32(counts[bin]);
    return mix(luminance_of(bin + 1u), luminance_of(bin), share);
}

@compute @workgroup_size(GROUP_THREADS)
fn main(@builtin(local_invocation_index) local: u32) {
    let bins = LUMINANCE_BINS / GROUP_THREADS;
    var sum = 0u;
    for (var i = 0u; i < bins; i += 1u) {
        sum += counts[local * bins + i];
    }
    parts[local] = sum;
    workgroupBarrier();
    if local != 0u {
        return;
    }
    var lit = 0u;
    for (var i = 0u; i < GROUP_THREADS; i += 1u) {
        lit += parts[i];
    }
    if lit > 0u {
        let bright = exceeded_by(lit / LIT_TO_BRIGHTER);
        exposure = PictureExposure(BRIGHT_SHOWN_AS / bright, bright, vec2<u32>(0u));
    } else {
        exposure = PictureExposure(1.0, 0.0, vec2<u32>(0u));
    }
}
