// Looks a point up in a shadow map: a layer for a sun or a spot, six around a point light. A kernel
// declares `shadow` and `shadow_map`, which holds distances along a layer's axis, in cells.
#import constants
#import shared/ray_walk.wgsl
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

// Beyond the edge lies what is at the edge: on the faces of a cube it goes on there.
fn inside_map(texel: vec2<i32>) -> vec2<i32> {
    return clamp(texel, vec2<i32>(0), vec2<i32>(i32(shadow.size_px) - 1));
}

// 1 where texel (x, y) of the layer lets light through to `distance`.
fn texel_lit(texel: vec2<i32>, layer: u32, distance: f32) -> f32 {
    return select(0.0, 1.0, textureLoad(shadow_map, inside_map(texel), layer, 0).x >= distance);
}

// In texels, from the centre of the first.
fn map_place(clip: vec4<f32>) -> vec2<f32> {
    return (clip.xy / clip.w * vec2<f32>(0.5, -0.5) + 0.5) * f32(shadow.size_px) - 0.5;
}

// Share of the four nearest texels that let light through to the point, by distance to their centres.
// A point that no layer sees is not hidden from the light.
fn lit_share(p: vec3<f32>) -> f32 {
    let layer = shadow_layer(p);
    if layer == shadow.count {
        return 1.0;
    }
    let clip = shadow.frames[layer].clip_from_grid * vec4<f32>(p, 1.0);
    let at = map_place(clip);
    let texel = vec2<i32>(floor(at));
    let f = at - floor(at);
    let distance = dot(shadow.frames[layer].distance, vec4<f32>(p, 1.0));
    let near = mix(texel_lit(texel, layer, distance), texel_lit(texel + vec2<i32>(1, 0), layer, distance), f.x);
    let far = mix(texel_lit(texel + vec2<i32>(0, 1), layer, distance), texel_lit(texel + vec2<i32>(1, 1), layer, distance), f.x);
    return mix(near, far, f.y);
}

// A plane through a point, as a layer of the map sees it.
struct PlaneInLayer {
    // Of the point.
    clip: vec4<f32>,
    distance: f32,
    // How the height above the plane grows with clip x and y and with the distance, cells.
    across: vec2<f32>,
    along: f32,
    // How clip w does with the distance: 0 for a sun.
    widening: f32,
    // Lower than this is the plane itself.
    least_height: f32,
}

fn plane_in_layer(p: vec3<f32>, normal: vec3<f32>, layer: u32) -> PlaneInLayer {
    let frame = shadow.frames[layer];
    let rows = transpose(frame.clip_from_grid);
    let clip = frame.clip_from_grid * vec4<f32>(p, 1.0);
    let squares = vec2<f32>(dot(rows[0].xyz, rows[0].xyz), dot(rows[1].xyz, rows[1].xyz));
    let across = vec2<f32>(dot(normal, rows[0].xyz), dot(normal, rows[1].xyz)) / squares;
    let texel = 2.0 * clip.w * inverseSqrt(min(squares.x, squares.y)) / f32(shadow.size_px);
    return PlaneInLayer(
        clip,
        dot(frame.distance, vec4<f32>(p, 1.0)),
        across,
        dot(normal, frame.distance.xyz),
        dot(rows[3].xyz, frame.distance.xyz),
        SHADOW_HEIGHT_TEXELS * texel + SHADOW_HEIGHT_CELLS,
    );
}

// 0 where what the texel sees lies above the plane and hides it. A texel whose ray never comes down to the
// plane sees what may be far behind the point: then the distance tells.
fn texel_clear(texel: vec2<i32>, layer: u32, plane: PlaneInLayer) -> f32 {
    let inside = inside_map(texel);
    let distance = textureLoad(shadow_map, inside, layer, 0).x;
    if distance >= NEVER {
        return 1.0;
    }
    let centre = ((vec2<f32>(inside) + 0.5) / f32(shadow.size_px) * 2.0 - 1.0) * vec2<f32>(1.0, -1.0);
    let beyond = distance - plane.distance;
    let w = plane.clip.w + plane.widening * beyond;
    let height = dot(centre * w - plane.clip.xy, plane.across) + plane.along * beyond;
    let comes_down = plane.along + plane.widening * dot(centre, plane.across) < 0.0;
    return select(1.0, 0.0, height > plane.least_height && (comes_down || beyond < 0.0));
}

// Share of the four nearest texels that let light through to a point of a plane whose `normal` is on the
// light's side. The plane does not hide itself, however it is turned, and shadows end where their texels do.
fn lit_share_of_plane(p: vec3<f32>, normal: vec3<f32>) -> f32 {
    let layer = shadow_layer(p);
    if layer == shadow.count {
        return 1.0;
    }
    let plane = plane_in_layer(p, normal, layer);
    let at = map_place(plane.clip);
    let texel = vec2<i32>(floor(at));
    let near = mix(texel_clear(texel, layer, plane), texel_clear(texel + vec2<i32>(1, 0), layer, plane), fract(at.x));
    let far = mix(texel_clear(texel + vec2<i32>(0, 1), layer, plane), texel_clear(texel + vec2<i32>(1, 1), layer, plane), fract(at.x));
    return mix(near, far, fract(at.y));
}
