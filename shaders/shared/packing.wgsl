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

// Rounding puts a packed unit vector's end up to √3/2 of 1/511 away, so its squared length lies within
// √3/511 + (√3/2/511)² of 1, and f32 adds less than the rest.
const PACKED_UNIT_SLACK: f32 = 0.0034;

// A vector too short to have a direction packs as zero length. A length that packing itself explains is
// left alone: stretching it to 1 would change the bits of normals that do not turn.
fn pack_normal(normal: vec3<f32>) -> u32 {
    let square = dot(normal, normal);
    if !(square > 1e-30) {
        return pack_biased(vec3<u32>(NORMAL_MAX));
    }
    let unit = normal * select(inverseSqrt(square), 1.0, abs(square - 1.0) < PACKED_UNIT_SLACK);
    let rounded = vec3<i32>(floor(clamp(unit, vec3(-1.0), vec3(1.0)) * f32(NORMAL_MAX) + 0.5));
    return pack_biased(vec3<u32>(rounded + vec3<i32>(i32(NORMAL_MAX))));
}
