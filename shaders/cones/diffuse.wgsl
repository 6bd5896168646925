// What the surfaces of an image receive by diffuse cones: mean radiance over the cosine-weighted hemisphere,
// and how open it is (section 4.5). A thread a pixel of the diffuse image, which may be smaller than that of
// the surfaces. A square of `pattern_px`² pixels shares a set of directions; each pixel traces its part.
#import shared/thread_pixel.wgsl
#import shared/look_up.wgsl
#import shared/cone.wgsl
#import shared/cone_set.wgsl
#import shared/image.wgsl
#import shared/surface.wgsl

struct DiffuseParams {
    // Radiance behind all that is in the grid, nits.
    sky: vec3<f32>,
    // Cones a pixel.
    count: u32,
    shape: ConeShape,
    size_px: vec2<u32>,
    // Side of the square that shares a set.
    pattern_px: u32,
    // What is farther away occludes nothing, cells.
    occlusion_cells: f32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> params: DiffuseParams;
@group(0) @binding(3) var<storage, read> blocks: array<u32>;
@group(0) @binding(4) var<storage, read> ranks: array<u32>;
@group(0) @binding(5) var<storage, read> first_child: array<u32>;
@group(0) @binding(6) var<storage, read> neighbours: array<u32>;
@group(0) @binding(7) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(8) var<storage, read> block_starts: array<u32>;
@group(0) @binding(9) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(10) var surface_near: texture_2d<u32>;
@group(0) @binding(11) var surface_stuff: texture_2d<u32>;
@group(0) @binding(12) var<storage, read_write> diffuse: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

// Mean radiance of a pixel's cones, and their open share.
fn hemisphere(s: Surface, part: u32) -> vec4<f32> {
    let basis = basis_of(s.normal);
    let apex = s.position + params.shape.start_cells * s.face;
    set_horizon(s.position, s.face);
    let parts = params.pattern_px * params.pattern_px;
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < params.count; i += 1u) {
        let direction = basis * cosine_direction(part + i * parts, params.count * parts);
        let seen = trace_cone(params.shape, params.occlusion_cells, apex, above_face(direction, s.face));
        let behind = select(seen.open, seen.through, RADIANCE);
        sum += vec4<f32>(seen.radiance + behind * params.sky, seen.open);
    }
    return sum / f32(params.count);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = image_pixel(id, groups, params.size_px);
    if !pixel.is_there {
        return;
    }
    let s = surface_at(source_pixel(pixel.at, params.size_px));
    let part = pixel.at.x % params.pattern_px + params.pattern_px * (pixel.at.y % params.pattern_px);
    var found = vec4<f32>(0.0, 0.0, 0.0, 1.0);
    if s.is_there {
        found = hemisphere(s, part);
    }
    diffuse[pixel.index] = found;
}
