// Unit vectors in 16 | 16 bits: mirror of data::surface_image::pack_octahedral.

// 1 with the sign of each component; 0 counts as positive.
fn signs(v: vec2<f32>) -> vec2<f32> {
    return select(vec2<f32>(-1.0), vec2<f32>(1.0), v >= vec2<f32>(0.0));
}

fn pack_octahedral(n: vec3<f32>) -> u32 {
    let flat = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return pack2x16unorm(select(flat, (1.0 - abs(flat.yx)) * signs(flat), n.z < 0.0) * 0.5 + 0.5);
}

fn unpack_octahedral(packed: u32) -> vec3<f32> {
    let flat = unpack2x16unorm(packed) * 2.0 - 1.0;
    let z = 1.0 - abs(flat.x) - abs(flat.y);
    return normalize(vec3<f32>(flat - signs(flat) * max(-z, 0.0), z));
}
