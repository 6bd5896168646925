// From a small image to one as large as that of the surfaces: between the four pixels around each, weighted
// by how much their surfaces have in common with it. Where none has anything, the one nearest in depth
// counts. A thread a pixel. Of a constant image the same constant, to the bit.
#import shared/thread_pixel.wgsl
#import shared/image.wgsl
#import shared/edges.wgsl

struct UpsampleParams {
    size_px: vec2<u32>,
    pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> params: UpsampleParams;
@group(0) @binding(2) var surface_near: texture_2d<u32>;
@group(0) @binding(3) var surface_stuff: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> image: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> large: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;
// Pixels whose last channel is 0 hold nothing.
override SPARSE: bool = false;

// Of the four around a pixel, the upper left: the last whose source is not behind it. May be −1.
fn first_pixel(pixel: vec2<u32>) -> vec2<i32> {
    let size = vec2<u32>(view.width_px, view.height_px);
    // Source (2i + 1)·W / 2w rounded down ≤ x; shifted by 2W to stay above zero.
    return vec2<i32>((2u * (pixel + 1u) * params.size_px + size - 1u) / (2u * size)) - 1;
}

fn upsample(s: Surface, pixel: vec2<u32>) -> vec4<f32> {
    let first = first_pixel(pixel);
    let last = vec2<i32>(params.size_px) - 1;
    let near = vec2<u32>(clamp(first, vec2<i32>(0), last));
    let far = vec2<u32>(clamp(first + 1, vec2<i32>(0), last));
    let start = vec2<f32>(source_pixel(near, params.size_px));
    let to = vec2<f32>(source_pixel(far, params.size_px));
    let share = clamp((vec2<f32>(pixel) - start) / max(to - start, vec2<f32>(1.0)), vec2<f32>(0.0), vec2<f32>(1.0));
    let width_cells = plane_width(s, max(to.x - start.x, 1.0), pixel_ray(pixel));
    var weight = 0.0;
    var most = 0.0;
    var nearest = NEVER;
    var base = vec4<f32>(0.0);
    var values: array<vec4<f32>, 4>;
    var weights: array<f32, 4>;
    for (var i = 0u; i < 4u; i += 1u) {
        let is_far = vec2<bool>((i & 1u) != 0u, (i & 2u) != 0u);
        let at = select(near, far, is_far);
        let part = select(1.0 - share, share, is_far);
        let other = surface_at(source_pixel(at, params.size_px));
        values[i] = image[at.y * params.size_px.x + at.x];
        if !other.is_there || (SPARSE && values[i].w == 0.0) {
            continue;
        }
        let w = part.x * part.y * alike(s, other, width_cells);
        weights[i] = select(w, 0.0, w < LEAST_WEIGHT);
        let away = abs(other.distance - s.distance);
        if weights[i] > most || (most == 0.0 && away < nearest) {
            base = values[i];
        }
        weight += weights[i];
        most = max(most, weights[i]);
        nearest = min(nearest, away);
    }
    // Relative to one of them, so that what is constant stays as it is.
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < 4u; i += 1u) {
        sum += weights[i] * (values[i] - base);
    }
    return max(base + sum / max(weight, LEAST_WEIGHT), vec4<f32>(0.0));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let s = surface_at(pixel.at);
    var found = vec4<f32>(0.0, 0.0, 0.0, 1.0);
    if s.is_there {
        found = upsample(s, pixel.at);
    }
    large[pixel.index] = found;
}
