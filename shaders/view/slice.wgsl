// Shows a plane through the grid: what the octree holds there, sampled (section 4.4), in the colours of a
// scale. Values are mean light, or occupancy; where nothing is, there is no mean light, and the plane is
// background. In: the lit octree, a view, a plane. Out: the picture, and the distance to the plane.
#import shared/thread_pixel.wgsl
#import shared/look_up.wgsl
#import shared/mean_light.wgsl
#import shared/palette.wgsl
#import shared/store_pixel.wgsl

struct SliceParams {
    // The plane lies across this axis, at this height.
    axis: u32,
    height_cells: f32,
    // Level, or for quadrilinear sampling width in cells.
    at: f32,
    // Bits SLICE_*.
    flags: u32,
    // Values at the scale's ends; with SLICE_OF_MEAN in mean luminances of all light, which is 1 where there is none.
    least: f32,
    most: f32,
    pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> palette: Palette;
@group(0) @binding(3) var<uniform> params: SliceParams;
@group(0) @binding(4) var<storage, read> blocks: array<u32>;
@group(0) @binding(5) var<storage, read> ranks: array<u32>;
@group(0) @binding(6) var<storage, read> first_child: array<u32>;
@group(0) @binding(7) var<storage, read> neighbours: array<u32>;
@group(0) @binding(8) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(9) var<storage, read> block_starts: array<u32>;
@group(0) @binding(10) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(11) var picture: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(12) var depth: texture_storage_2d<r32float, write>;

override WORKGROUP_SIZE: u32 = 64u;

// A colour, and its distance from the eye; NEVER where the plane shows nothing.
struct Shown {
    color: vec3<f32>,
    depth_cells: f32,
}

// When a ray meets the plane inside the grid, else NEVER.
fn meets_plane(ray: PixelRay) -> f32 {
    let speed = ray.direction[params.axis];
    if abs(speed) <= STANDSTILL {
        return NEVER;
    }
    let t = (params.height_cells - ray.origin[params.axis]) / speed;
    let p = ray.origin + t * ray.direction;
    let beside = (p < vec3<f32>(0.0)) | (p >= vec3<f32>(f32(grid_cells())));
    let across = vec3<bool>(params.axis == 0u, params.axis == 1u, params.axis == 2u);
    if !(t >= 0.0) || any(beside & !across) {
        return NEVER;
    }
    return t;
}

fn unit_of_scale() -> f32 {
    if (params.flags & SLICE_OF_MEAN) == 0u {
        return 1.0;
    }
    let mean = mean_luminance();
    return select(1.0, mean, mean > 0.0);
}

// Where a value lies on the scale: 0 … 1, or beyond its ends.
fn share_of(value: f32) -> f32 {
    let unit = unit_of_scale();
    let least = params.least * unit;
    let most = params.most * unit;
    if (params.flags & SLICE_LOGARITHMIC) == 0u {
        return (value - least) / (most - least);
    }
    return log2(max(value, least) / least) / log2(most / least);
}

fn shown(ray: PixelRay) -> Shown {
    let nothing = Shown(view.background, NEVER);
    let t = meets_plane(ray);
    if t == NEVER {
        return nothing;
    }
    var p = ray.origin + t * ray.direction;
    p[params.axis] = params.height_cells;
    let seen = sample_by_filter(params.at, p, ray.direction);
    var value = seen.w;
    if (params.flags & SLICE_OCCUPANCY) == 0u {
        if seen.w == 0.0 {
            return nothing;
        }
        value = luminance_of(seen.xyz) / seen.w;
    }
    let color = palette_value(share_of(value));
    return Shown(color, ray.start_cells + t);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let it = shown(pixel_ray(pixel.at));
    store_pixel(pixel.at, it.color, it.depth_cells);
}
