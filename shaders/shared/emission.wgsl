// Emission as voxels hold it, 20 bits a channel, and sums of it that outgrow a word.
#import constants
#import shared/wide.wgsl

fn pack_emission(emission: vec3<u32>) -> vec2<u32> {
    return vec2<u32>(emission.x | (emission.y << 20u), (emission.y >> 12u) | (emission.z << 8u));
}

fn unpack_emission(packed: vec2<u32>) -> vec3<u32> {
    return vec3<u32>(packed.x & EMISSION_MAX, (packed.x >> 20u) | ((packed.y & 0xffu) << 12u), (packed.y >> 8u) & EMISSION_MAX);
}

// sum + weight·value: 24 and 20 bits give 44, so 2^20 voxels fit.
fn add_product(sum: vec2<u32>, weight: u32, value: u32) -> vec2<u32> {
    let high = (weight >> 12u) * value;
    let low = (weight & 0xfffu) * value;
    return wide_add(wide_add(sum, vec2<u32>(high << 12u, high >> 20u)), vec2<u32>(low, 0u));
}
