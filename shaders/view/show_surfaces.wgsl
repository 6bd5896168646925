// The picture of what was composed: light by exposure and tone curve, depth by a scale, all else as it is.
#import shared/thread_pixel.wgsl
#import shared/palette.wgsl
#import shared/picture_exposure.wgsl
#import shared/store_pixel.wgsl

override SHOWS: u32 = 0u;
override CURVE: u32 = 0u;

struct ShowSurfacesParams {
    // Ends of the scale of depths, scene units.
    least: f32,
    most: f32,
    // 1: where no surface is, the sky shines.
    sky: u32,
    pad: u32,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> params: ShowSurfacesParams;
@group(0) @binding(2) var<uniform> palette: Palette;
@group(0) @binding(3) var surface_near: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> shown: array<vec4<f32>>;
@group(0) @binding(5) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(6) var depth: texture_storage_2d<r32float, write>;
@group(0) @binding(7) var<uniform> exposure: PictureExposure;

override WORKGROUP_SIZE: u32 = 64u;

fn tone_mapped(x: vec3<f32>) -> vec3<f32> {
    switch CURVE {
        case CURVE_REINHARD: { return x / (1.0 + x); }
        case CURVE_ACES: { return x * (ACES_A * x + ACES_B) / (x * (ACES_C * x + ACES_D) + ACES_E); }
        default: { return x; }
    }
}

fn color_of(value: vec3<f32>) -> vec3<f32> {
    switch SHOWS {
        // Beyond this every curve is at its end, and its squares stay finite.
        case SHOWS_LIGHT: { return tone_mapped(min(exposure.factor * value, vec3<f32>(1e6))); }
        case SHOWS_NORMAL: { return linear_from_gamma(0.5 * value + 0.5); }
        case SHOWS_DEPTH: { return palette_value((params.most - value.x) / (params.most - params.least)); }
        default: { return value; }
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let value = shown[pixel.index];
    let distance = bitcast<f32>(textureLoad(surface_near, pixel.at, 0).x);
    let is_there = value.a > 0.0 || (SHOWS == SHOWS_LIGHT && params.sky != 0u);
    store_pixel(pixel.at, select(view.background, color_of(value.rgb), is_there), distance);
}
