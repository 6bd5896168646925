// Exact sums of what falls into one leaf. A weight (up to 2^24) is split, so that each product fits: for albedo in three
// bytes, MAX_FRAGMENTS · 256 · 16256 < 2^32, for the rest in two 12-bit halves, MAX_FRAGMENTS · 4096 · 1022 < 2^32.
// Each mean is divided once.
#import shared/albedo.wgsl
#import shared/packing.wgsl
#import shared/wide.wgsl

const HALF_BITS: u32 = 12u;
const HALF_MASK: u32 = 4095u;

struct LeafSum {
    // Albedo.
    color_high: vec3<u32>,
    color_middle: vec3<u32>,
    color_low: vec3<u32>,
    // Biased normal and, in w, the weight itself.
    normal_high: vec4<u32>,
    normal_low: vec4<u32>,
}

fn empty_leaf() -> LeafSum {
    return LeafSum(vec3<u32>(0u), vec3<u32>(0u), vec3<u32>(0u), vec4<u32>(0u), vec4<u32>(0u));
}

// `color` is albedo in units, `normal` biased with 1 in w.
fn add_fragment(sum: LeafSum, weight: u32, color: vec3<u32>, normal: vec4<u32>) -> LeafSum {
    return LeafSum(
        sum.color_high + (weight >> 16u) * color,
        sum.color_middle + ((weight >> 8u) & 0xffu) * color,
        sum.color_low + (weight & 0xffu) * color,
        sum.normal_high + (weight >> HALF_BITS) * normal,
        sum.normal_low + (weight & HALF_MASK) * normal,
    );
}

fn color_sum(sum: LeafSum, channel: u32) -> vec2<u32> {
    let upper = wide_add(wide_shl(vec2<u32>(sum.color_high[channel], 0u), 8u), vec2<u32>(sum.color_middle[channel], 0u));
    return wide_add(wide_shl(upper, 8u), vec2<u32>(sum.color_low[channel], 0u));
}

// Channel 3 is the weight.
fn normal_sum(sum: LeafSum, channel: u32) -> vec2<u32> {
    return wide_add(wide_shl(vec2<u32>(sum.normal_high[channel], 0u), HALF_BITS), vec2<u32>(sum.normal_low[channel], 0u));
}

// A resolved leaf, three words: occupancy (2^24 is full, clamped), albedo, mean biased normal.
struct Leaf {
    occupancy: u32,
    albedo: u32,
    normal: u32,
}

// Of sums of albedo and normal by their weight.
fn leaf_of(weight: vec2<u32>, color: array<vec2<u32>, 3>, normal: array<vec2<u32>, 3>) -> Leaf {
    if weight.x == 0u && weight.y == 0u {
        return Leaf(0u, 0u, 0u);
    }
    let albedo = vec3<u32>(wide_mean(color[0], weight), wide_mean(color[1], weight), wide_mean(color[2], weight));
    let mean = vec3<u32>(wide_mean(normal[0], weight), wide_mean(normal[1], weight), wide_mean(normal[2], weight));
    let occupancy = select(min(weight.x, FULL_WEIGHT), FULL_WEIGHT, weight.y != 0u);
    return Leaf(occupancy, pack_albedo(albedo), pack_biased(mean));
}

fn resolve_leaf(sum: LeafSum) -> Leaf {
    let color = array<vec2<u32>, 3>(color_sum(sum, 0u), color_sum(sum, 1u), color_sum(sum, 2u));
    let normal = array<vec2<u32>, 3>(normal_sum(sum, 0u), normal_sum(sum, 1u), normal_sum(sum, 2u));
    return leaf_of(normal_sum(sum, 3u), color, normal);
}
