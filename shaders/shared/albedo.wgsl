// How albedo is stored: mirror of data::albedo.
#import constants
#import shared/packing.wgsl

// Linear, and what stands beside it: coverage of a voxel, alpha of a vertex.
fn unpack_color(packed: u32) -> vec4<f32> {
    let color = unpack4x8unorm(packed);
    return vec4<f32>(color.rgb * color.rgb, color.a);
}

// What a voxel's codes add to a sum.
fn albedo_units(packed: u32) -> vec3<u32> {
    let code = (vec3<u32>(packed) >> vec3<u32>(0u, 8u, 16u)) & vec3<u32>(0xffu);
    return (code * code + 2u) >> vec3<u32>(2u);
}

// The code of leaves that is nearest to a mean of units: 8·√units, rounded.
fn albedo_code(units: u32) -> u32 {
    // A guess that is right or one too large: 8·√u ≥ c − ½ where 256·u ≥ (2c − 1)².
    let guess = u32(8.0 * sqrt(f32(units)) + 0.75);
    let odd = 2u * guess - 1u;
    return guess - select(0u, 1u, guess > 0u && odd * odd > 256u * units);
}

// Of three means of units.
fn pack_albedo(units: vec3<u32>) -> u32 {
    return pack_biased(vec3<u32>(albedo_code(units.x), albedo_code(units.y), albedo_code(units.z)));
}

// Linear albedo of a leaf or a node.
fn unpack_albedo(packed: u32) -> vec3<f32> {
    let code = vec3<f32>(unpack_position(packed)) / f32(ALBEDO_CODE_ONE);
    return code * code;
}
