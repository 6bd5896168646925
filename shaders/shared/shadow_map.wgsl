// Looks a point up in a shadow map: a layer for a sun or a spot, six around a point light. A kernel
// declares `shadow` and `shadow_map`, which holds distances along a layer's axis, in cells.
#import shared/shadow_frame.wgsl

struct ShadowParams {
    frames: array<ShadowFrame, 6>,
    count: u32,
    size_px: u32,
    pad: vec2<u32>,
}

// 1 where texel (x, y) of the layer lets light through to `distance`; beyond the map's edge nothing hides.
fn texel_lit(texel: vec2<i32>, layer: u32, distance: f32) -> f32 {
    if any(texel < vec2<i32>(0)) || any(texel >= vec2<i32>(i32(shadow.size_px))) {
        return 1.0;
    }
    return select(0.0, 1.0, textureLoad(shadow_map, texel, layer, 0).x >= distance);
}

// Share of the four nearest texels that let light through to the point, by distance to their centres.
fn lit_in_layer(p: vec3<f32>, layer: u32, clip: vec4<f32>) -> f32 {
    let ndc = clip.xy / clip.w;
    let at = (ndc * vec2<f32>(0.5, -0.5) + 0.5) * f32(shadow.size_px) - 0.5;
    let texel = vec2<i32>(floor(at));
    let f = at - floor(at);
    let distance = dot(shadow.frames[layer].distance, vec4<f32>(p, 1.0));
    let near = mix(texel_lit(texel, layer, distance), texel_lit(texel + vec2<i32>(1, 0), layer, distance), f.x);
    let far = mix(texel_lit(texel + vec2<i32>(0, 1), layer, distance), texel_lit(texel + vec2<i32>(1, 1), layer, distance), f.x);
    return mix(near, far, f.y);
}

// A point that no layer sees (behind a spot, at the light itself) is not hidden from it.
fn lit_share(p: vec3<f32>) -> f32 {
    for (var layer = 0u; layer < shadow.count; layer += 1u) {
        let clip = shadow.frames[layer].clip_from_grid * vec4<f32>(p, 1.0);
        if clip.w > 1e-6 && all(abs(clip.xy) <= vec2<f32>(clip.w)) {
            return lit_in_layer(p, layer, clip);
        }
    }
    return 1.0;
}
