// Shows a shadow map: distances from the light in the colours of a scale, its layers side by side (three
// a row), as large as the picture allows. Texels that nothing hides are background.
#import shared/thread_pixel.wgsl
#import shared/palette.wgsl
#import shared/store_pixel.wgsl

struct ShowShadowParams {
    // Distances of the scale's ends, cells.
    least: f32,
    most: f32,
    layers: u32,
    map_px: u32,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> palette: Palette;
@group(0) @binding(2) var<uniform> params: ShowShadowParams;
@group(0) @binding(3) var shadow_map: texture_2d_array<f32>;
@group(0) @binding(4) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(5) var depth: texture_storage_2d<r32float, write>;

override WORKGROUP_SIZE: u32 = 64u;

// Distance at a pixel; NEVER beside the map and where nothing is.
fn distance_at(pixel: vec2<u32>) -> f32 {
    let columns = min(params.layers, 3u);
    let rows = (params.layers + 2u) / 3u;
    let side = min(view.width_px / columns, view.height_px / rows);
    let corner = (vec2<u32>(view.width_px, view.height_px) - side * vec2<u32>(columns, rows)) / 2u;
    if side == 0u || any(pixel < corner) || any(pixel >= corner + side * vec2<u32>(columns, rows)) {
        return NEVER;
    }
    let at = pixel - corner;
    let layer = at.x / side + columns * (at.y / side);
    let texel = (at % side) * params.map_px / side;
    return textureLoad(shadow_map, texel, layer, 0).x;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let distance = distance_at(pixel.at);
    var color = view.background;
    if distance < NEVER {
        let share = (distance - params.least) / max(params.most - params.least, 1e-6);
        color = palette_value(share);
    }
    store_pixel(pixel.at, color, NEVER);
}
