// What an inner node holds, 16 bytes:
//
//   word 0, 1  occupancy: sum over its leaves, 2^24 a full leaf, 64 bits (one leaf at 512³ is 2^−27
//              of the root: no narrower storage would see it)
//   word 2     albedo, 10 | 10 | 10, as a leaf's, mean by occupancy
//   word 3     normal, 10 | 10 | 10 biased, mean by occupancy: short where normals disagree
#import shared/packing.wgsl
#import shared/wide.wgsl

// Occupancy-weighted sums over children. Weights are exact integers until they become f32 here.
struct NodeSum {
    low: u32,
    high: u32,
    weight: f32,
    // In squares of codes.
    albedo: vec3<f32>,
    normal: vec3<f32>,
}

fn empty_sum() -> NodeSum {
    return NodeSum(0u, 0u, 0.0, vec3<f32>(0.0), vec3<f32>(0.0));
}

fn add_child(sum: NodeSum, low: u32, high: u32, albedo: vec3<u32>, normal: vec3<u32>) -> NodeSum {
    var next = sum;
    next.low = sum.low + low;
    next.high = sum.high + high + select(0u, 1u, next.low < low);
    let weight = wide_to_float(vec2<u32>(low, high));
    next.weight = sum.weight + weight;
    let code = vec3<f32>(albedo);
    next.albedo = sum.albedo + weight * code * code;
    next.normal = sum.normal + weight * vec3<f32>(normal);
    return next;
}

fn finish_node(sum: NodeSum) -> vec4<u32> {
    if sum.low == 0u && sum.high == 0u {
        return vec4<u32>(0u);
    }
    let albedo = vec3<u32>(floor(sqrt(sum.albedo / sum.weight) + 0.5));
    let normal = vec3<u32>(floor(sum.normal / sum.weight + 0.5));
    return vec4<u32>(sum.low, sum.high, pack_biased(albedo), pack_biased(normal));
}
