// Exact sums of what falls into one leaf. A weight (up to 2^24) is split in two 12-bit halves, so
// that each product fits: MAX_FRAGMENTS · 4096 · 16256 < 2^32. sum = 4096·high + low, divided once.
#import shared/albedo.wgsl
#import shared/packing.wgsl

const HALF_BITS: u32 = 12u;
const HALF_MASK: u32 = 4095u;

struct LeafSum {
    // Albedo and, in w, the weight itself.
    color_high: vec4<u32>,
    color_low: vec4<u32>,
    // Biased normal.
    normal_high: vec3<u32>,
    normal_low: vec3<u32>,
}

fn empty_leaf() -> LeafSum {
    return LeafSum(vec4<u32>(0u), vec4<u32>(0u), vec3<u32>(0u), vec3<u32>(0u));
}

// `color` is albedo in units with 1 in w, `normal` biased.
fn add_fragment(sum: LeafSum, weight: u32, color: vec4<u32>, normal: vec3<u32>) -> LeafSum {
    let high = weight >> HALF_BITS;
    let low = weight & HALF_MASK;
    return LeafSum(
        sum.color_high + high * color,
        sum.color_low + low * color,
        sum.normal_high + high * normal,
        sum.normal_low + low * normal,
    );
}

// Carries, so that low < 4096.
fn carried(high: u32, low: u32) -> vec2<u32> {
    return vec2<u32>(high + (low >> HALF_BITS), low & HALF_MASK);
}

// Sign of 2·(s − quotient·w) − w, for s near quotient·w; s and w as (high, low) pairs.
fn rounds_up(s: vec2<u32>, quotient: u32, w: vec2<u32>) -> bool {
    let low = 2 * bitcast<i32>(s.y - quotient * w.y) - bitcast<i32>(w.y);
    let high = 2 * bitcast<i32>(s.x - quotient * w.x) - bitcast<i32>(w.x);
    return high + (low >> HALF_BITS) >= 0;
}

// s / w rounded half up, exactly: a float guess, then perhaps one step up.
fn rounded_quotient(s_high: u32, s_low: u32, w: vec2<u32>) -> u32 {
    let s = carried(s_high, s_low);
    let guess = (f32(s.x) * 4096.0 + f32(s.y)) / (f32(w.x) * 4096.0 + f32(w.y));
    // The guess is off by less than 1/100, so its floor never exceeds the rounded quotient.
    let quotient = u32(floor(guess));
    return quotient + select(0u, 1u, rounds_up(s, quotient, w));
}

// A resolved leaf, three words: occupancy (2^24 is full, clamped), albedo, mean biased normal.
struct Leaf {
    occupancy: u32,
    albedo: u32,
    normal: u32,
}

fn resolve_leaf(sum: LeafSum) -> Leaf {
    let w = carried(sum.color_high.w, sum.color_low.w);
    if w.x == 0u && w.y == 0u {
        return Leaf(0u, 0u, 0u);
    }
    let albedo = vec3<u32>(
        rounded_quotient(sum.color_high.x, sum.color_low.x, w),
        rounded_quotient(sum.color_high.y, sum.color_low.y, w),
        rounded_quotient(sum.color_high.z, sum.color_low.z, w),
    );
    let normal = vec3<u32>(
        rounded_quotient(sum.normal_high.x, sum.normal_low.x, w),
        rounded_quotient(sum.normal_high.y, sum.normal_low.y, w),
        rounded_quotient(sum.normal_high.z, sum.normal_low.z, w),
    );
    var occupancy = FULL_WEIGHT;
    if w.x < (FULL_WEIGHT >> HALF_BITS) {
        occupancy = (w.x << HALF_BITS) | w.y;
    }
    return Leaf(occupancy, pack_albedo(albedo), pack_biased(normal));
}
