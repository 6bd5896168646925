// Looks a point up in a shadow map: a layer for a sun or a spot, six around a point light. A kernel
// declares `shadow` and `shadow_map`, which holds distances along a layer's axis, in cells.
#import shared/shadow_frame.wgsl

struct ShadowParams {
    frames: array<ShadowFrame, 6>,
    count: u32,
    size_px: u32,
    pad: vec2<u32>,
}

// The layer that sees a point; `shadow.count` where none does: behind a spot, at the light itself.
fn shadow_layer(p: vec3<f32>) -> u32 {
    for (var layer = 0u; layer < shadow.count; layer += 1u) {
        let clip = shadow.frames[layer].clip_from_grid * vec4<f32>(p, 1.0);
        if clip.w > 1e-6 && all(abs(clip.xy) <= vec2<f32>(clip.w)) {
            return layer;
        }
    }
    return shadow.count;
}

// 1 where texel (x, y) of the layer lets light through to `distance`. Beyond the edge lies what is at the
// edge: on the faces of a cube it goes on there.
fn texel_lit(texel: vec2<i32>, layer: u32, distance: f32) -> f32 {
    let inside = clamp(texel, vec2<i32>(0), vec2<i32>(i32(shadow.size_px) - 1));
    return select(0.0, 1.0, textureLoad(shadow_map, inside, layer, 0).x >= distance);
}

// Share of the four nearest texels that let light through to the point, by distance to their centres.
// A point that no layer sees is not hidden from the light.
fn lit_share(p: vec3<f32>) -> f32 {
    let layer = shadow_layer(p);
    if layer == shadow.count {
        return 1.0;
    }
    let clip = shadow.frames[layer].clip_from_grid * vec4<f32>(p, 1.0);
    let ndc = clip.xy / clip.w;
    let at = (ndc * vec2<f32>(0.5, -0.5) + 0.5) * f32(shadow.size_px) - 0.5;
    let texel = vec2<i32>(floor(at));
    let f = at - floor(at);
    let distance = dot(shadow.frames[layer].distance, vec4<f32>(p, 1.0));
    let near = mix(texel_lit(texel, layer, distance), texel_lit(texel + vec2<i32>(1, 0), layer, distance), f.x);
    let far = mix(texel_lit(texel + vec2<i32>(0, 1), layer, distance), texel_lit(texel + vec2<i32>(1, 1), layer, distance), f.x);
    return mix(near, far, f.y);
}

// How far above a plane a point of it must be moved so that the plane does not hide it, cells. The four
// texels' centres are at most a texel away along either axis of the map; there the plane rises by the part
// of its normal along that axis.
fn clear_of_plane(p: vec3<f32>, normal: vec3<f32>) -> f32 {
    let layer = shadow_layer(p);
    if layer == shadow.count {
        return 0.0;
    }
    let rows = transpose(shadow.frames[layer].clip_from_grid);
    let across = abs(dot(normal, rows[0].xyz)) / dot(rows[0].xyz, rows[0].xyz) + abs(dot(normal, rows[1].xyz)) / dot(rows[1].xyz, rows[1].xyz);
    return across * 2.0 * dot(rows[3], vec4<f32>(p, 1.0)) / f32(shadow.size_px);
}
