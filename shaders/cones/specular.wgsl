// What glossy surfaces reflect: one cone a pixel about the mirror direction, as wide as the roughness makes it
// (section 4.5), the sky behind. A thread a pixel of the listed tiles, whose number `list` begins with. `specular`, cleared before, gets 1 in
// its last channel where a cone was traced.
#import shared/threads.wgsl
#import shared/corners_ranked.wgsl
#import shared/cone.wgsl
#import shared/cone_set.wgsl
#import shared/image.wgsl
#import shared/glossy.wgsl

struct SpecularParams {
    // Radiance behind all that is in the grid, nits.
    sky: vec3<f32>,
    most_roughness: f32,
    // The widening is a pixel's own.
    shape: ConeShape,
    size_px: vec2<u32>,
    pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> view: ViewParams;
@group(0) @binding(2) var<uniform> params: SpecularParams;
@group(0) @binding(3) var<storage, read> blocks: array<u32>;
@group(0) @binding(4) var<storage, read> ranks: array<u32>;
@group(0) @binding(5) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(6) var<storage, read> block_starts: array<u32>;
@group(0) @binding(7) var<storage, read> light: array<vec4<f32>>;
@group(0) @binding(8) var surface_near: texture_2d<u32>;
@group(0) @binding(9) var surface_stuff: texture_2d<u32>;
@group(0) @binding(10) var<storage, read> list: array<u32>;
@group(0) @binding(11) var<storage, read_write> specular: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

fn entry_of(level: u32, node: vec3<i32>) -> u32 {
    return ranked_entry(level, node);
}

fn corners_of(level: u32, base: vec3<i32>) -> Corners {
    return ranked_corners(level, base);
}

// 2·tan(a / 2) of the cone that holds half of the reflected light: half of GGX' normals lie within atan(α) of
// the mean, α being the roughness squared, and reflections turn by twice that.
fn lobe_widening(roughness: f32) -> f32 {
    let tangent = roughness * roughness;
    let doubled = 2.0 * tangent / max(1.0 - tangent * tangent, 0.5);
    return 2.0 * clamp(doubled, NARROWEST_TANGENT, WIDEST_TANGENT);
}

fn reflection(s: Surface) -> vec4<f32> {
    var shape = params.shape;
    shape.widening = lobe_widening(s.roughness);
    let apex = s.position + shape.start_cells * s.face;
    let direction = above_face(reflect(s.from_eye, s.normal), s.face);
    set_horizon(s.position, s.face);
    let seen = trace_cone(shape, 0.0, apex, direction);
    return vec4<f32>(seen.radiance + seen.through * params.sky, 1.0);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= min(threads.end, 64u * list[0]) {
        return;
    }
    let pixel = pixel_of_tile(params.size_px.x, list[1u + thread / 64u], thread % 64u);
    if any(pixel >= params.size_px) {
        return;
    }
    let s = surface_at(source_pixel(pixel, params.size_px));
    if is_glossy(s, params.most_roughness) {
        specular[pixel.y * params.size_px.x + pixel.x] = reflection(s);
    }
}
