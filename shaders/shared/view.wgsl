// What the views share: the ray of a pixel, light and colour, lines at voxel borders.
#import constants
#import shared/gamma.wgsl
#import shared/ray_walk.wgsl
#import shared/transmittance.wgsl

struct ViewParams {
    // Ray of the picture point (x, y), −1 … 1 to the right and up, in leaf cells: each vector is
    // v + x·v_x + y·v_y. Rays start on a plane in front of the grid, not at a far eye.
    origin: vec3<f32>,
    width_px: u32,
    origin_x: vec3<f32>,
    height_px: u32,
    origin_y: vec3<f32>,
    // Distance from the eye to that plane, for a direction of length 1 across it, cells.
    start_cells: f32,
    direction: vec3<f32>,
    // Octree level that is shown.
    level: u32,
    direction_x: vec3<f32>,
    color_by: u32,
    direction_y: vec3<f32>,
    // Bits VIEW_*.
    flags: u32,
    // Linear.
    background: vec3<f32>,
    pad: u32,
}

// 256 linear colours: of a value 0 … 1, or of a number modulo 256.
struct Palette {
    colors: array<vec4<f32>, 256>,
}

// A ray, and how its t relates to the picture.
struct PixelRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
    // Distance from the eye to the origin, cells.
    start_cells: f32,
    // Width of a pixel at the origin and its growth with t, cells.
    width: f32,
    widening: f32,
}

// Pixel i of a tile of 8 x 8 of a picture, in Morton order: neighbours in a workgroup see similar voxels. The last
// tiles reach beyond the picture.
fn pixel_of_tile(width_px: u32, tile: u32, i: u32) -> vec2<u32> {
    let tiles_x = (width_px + 7u) / 8u;
    let x = (i & 1u) | ((i >> 1u) & 2u) | ((i >> 2u) & 4u);
    let y = ((i >> 1u) & 1u) | ((i >> 2u) & 2u) | ((i >> 3u) & 4u);
    return vec2<u32>(8u * (tile % tiles_x) + x, 8u * (tile / tiles_x) + y);
}

fn pixel_ray(pixel: vec2<u32>) -> PixelRay {
    let size = vec2<f32>(f32(view.width_px), f32(view.height_px));
    let at = (2.0 * vec2<f32>(pixel) + 1.0) / size * vec2<f32>(1.0, -1.0) + vec2<f32>(-1.0, 1.0);
    let origin = view.origin + at.x * view.origin_x + at.y * view.origin_y;
    let across = view.direction + at.x * view.direction_x + at.y * view.direction_y;
    let steepness = length(across);
    let direction = across / max(steepness, STANDSTILL);
    let width = 2.0 * length(view.origin_y) / size.y;
    let widening = 2.0 * length(view.direction_y) / size.y / max(steepness, STANDSTILL);
    return PixelRay(origin, direction, view.start_cells * steepness, width, widening);
}

// A light at the eye; normals count from both sides.
fn headlight(color: vec3<f32>, normal: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let square = dot(normal, normal);
    if (view.flags & VIEW_SHADED) == 0u || square == 0.0 {
        return color;
    }
    return color * (AMBIENT + (1.0 - AMBIENT) * abs(dot(normal, direction)) * inverseSqrt(square));
}

// The normal of the face through which a walk entered, against the ray.
fn face_normal(ray: Ray, entered: vec3<bool>) -> vec3<f32> {
    return select(vec3<f32>(0.0), select(vec3<f32>(1.0), vec3<f32>(-1.0), ray.forward), entered);
}

// Darkens a pixel-thin line along the borders of the face at `p` (in the walked cells).
fn edged(color: vec3<f32>, p: vec3<f32>, walk: Walk, pixel_width: f32) -> vec3<f32> {
    if (view.flags & VIEW_EDGES) == 0u || !any(walk.entered) {
        return color;
    }
    let inside = p - vec3<f32>(walk.cell);
    let to_border = select(min(inside, 1.0 - inside), vec3<f32>(1.0), walk.entered);
    let distance_px = min(to_border.x, min(to_border.y, to_border.z)) / pixel_width;
    let fade = clamp((1.0 / pixel_width - EDGE_FROM_PX) / (EDGE_FULL_PX - EDGE_FROM_PX), 0.0, 1.0);
    let line = clamp(1.5 - distance_px, 0.0, 1.0) * fade;
    return color * (1.0 - (1.0 - EDGE_SHADE) * line);
}

// Light on its way to the eye, front to back.
struct Blend {
    color: vec3<f32>,
    // Share that still comes through.
    through: f32,
    // Where half was stopped, cells from the eye.
    depth_cells: f32,
}

fn blended(before: Blend, color: vec3<f32>, alpha: f32, depth_cells: f32) -> Blend {
    let through = before.through * (1.0 - alpha);
    let halfway = before.through >= 0.5 && through < 0.5;
    return Blend(before.color + (before.through - through) * color, through, select(before.depth_cells, depth_cells, halfway));
}

// How much a voxel of occupancy `a` stops over `length_cells` leaf cells.
fn voxel_alpha(a: f32, length_cells: f32) -> f32 {
    if (view.flags & VIEW_LENGTH_RULE) == 0u || a >= 1.0 {
        return min(a, 1.0);
    }
    return 1.0 - transmittance(a, length_cells);
}
