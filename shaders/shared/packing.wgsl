// Bit packing shared by CPU and GPU: mirror of data::packing.
#import constants

fn unpack_position(packed: u32) -> vec3<u32> {
    return (vec3<u32>(packed) >> vec3<u32>(0u, 10u, 20u)) & vec3<u32>(0x3ffu);
}

// Biased components, 0 ..= 2·NORMAL_MAX; sums of them are sums of unsigned integers.
fn unpack_biased(packed: u32) -> vec3<u32> {
    return (vec3<u32>(packed) >> vec3<u32>(0u, 10u, 20u)) & vec3<u32>(0x3ffu);
}

fn pack_biased(biased: vec3<u32>) -> u32 {
    return biased.x | (biased.y << 10u) | (biased.z << 20u);
}

fn unpack_normal(packed: u32) -> vec3<f32> {
    return vec3<f32>(vec3<i32>(unpack_biased(packed)) - vec3<i32>(i32(NORMAL_MAX))) / f32(NORMAL_MAX);
}

// A vector too short to have a direction packs as zero length.
fn pack_normal(normal: vec3<f32>) -> u32 {
    let square = dot(normal, normal);
    if !(square > 1e-30) {
        return pack_biased(vec3<u32>(NORMAL_MAX));
    }
    let unit = normal * inverseSqrt(square);
    let rounded = vec3<i32>(floor(clamp(unit, vec3(-1.0), vec3(1.0)) * f32(NORMAL_MAX) + 0.5));
    return pack_biased(vec3<u32>(rounded + vec3<i32>(i32(NORMAL_MAX))));
}

fn unpack_rgb8(packed: u32) -> vec3<u32> {
    return (vec3<u32>(packed) >> vec3<u32>(0u, 8u, 16u)) & vec3<u32>(0xffu);
}

fn pack_rgb8(color: vec3<u32>) -> u32 {
    return color.x | (color.y << 8u) | (color.z << 16u);
}
