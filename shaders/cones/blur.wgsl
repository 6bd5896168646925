// Spreads what the pixels of a pattern have traced over all of them, along one axis: a Gaussian that stops at
// edges of the surfaces (section 4.5). A thread a pixel. Of a constant image nothing changes, to the bit.
#import shared/thread_pixel.wgsl
#import shared/image.wgsl
#import shared/edges.wgsl

struct BlurParams {
    size_px: vec2<u32>,
    // Of the filter, to each side.
    radius_px: u32,
    // Along rows, or columns.
    vertical: u32,
    // By distance in pixels.
    weights: array<vec4<f32>, 2>,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> params: BlurParams;
@group(0) @binding(2) var surface_near: texture_2d<u32>;
@group(0) @binding(3) var surface_stuff: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> image: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> blurred: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

fn blur(s: Surface, pixel: vec2<i32>, width_cells: f32) -> vec4<f32> {
    let along = select(vec2<i32>(1, 0), vec2<i32>(0, 1), params.vertical != 0u);
    let size = vec2<i32>(params.size_px);
    let middle = image[pixel.y * size.x + pixel.x];
    let radius = i32(params.radius_px);
    var sum = vec4<f32>(0.0);
    var weight = params.weights[0].x;
    for (var i = -radius; i <= radius; i += 1) {
        let at = pixel + i * along;
        if i == 0 || any(at < vec2<i32>(0)) || any(at >= size) {
            continue;
        }
        let other = surface_at(source_pixel(vec2<u32>(at), params.size_px));
        let distance = u32(abs(i));
        let w = params.weights[distance >> 2u][distance & 3u] * alike(s, other, width_cells);
        // Relative to the middle, so that what is constant stays as it is.
        sum += w * (image[at.y * size.x + at.x] - middle);
        weight += w;
    }
    return max(middle + sum / weight, vec4<f32>(0.0));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = image_pixel(id, groups, params.size_px);
    if !pixel.is_there {
        return;
    }
    let source = source_pixel(pixel.at, params.size_px);
    let s = surface_at(source);
    if !s.is_there {
        blurred[pixel.index] = image[pixel.index];
        return;
    }
    let spacing = f32(view.width_px) / f32(params.size_px.x);
    blurred[pixel.index] = blur(s, vec2<i32>(pixel.at), plane_width(s, spacing, pixel_ray(source)));
}
