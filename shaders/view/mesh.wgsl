// Draws posed triangles with the camera, light and colours of the voxels. In: vertices by number, a
// matrix an object or joint. Out: as march. Entry points `rigid` and `skinned` differ in how a
// vertex moves; the second exists only where a scene has skins.
#import shared/packing.wgsl
#import shared/view.wgsl

struct MeshParams {
    // From camera space in cells: x right, y up, z backward. Depth is reversed.
    clip_from_camera: mat4x4<f32>,
    world_from_camera: mat3x3<f32>,
}

struct MeshVertex {
    position: vec3<f32>,
    // Packed.
    normal: u32,
    tex_coord: vec2<f32>,
    // Linear, 8 bits each.
    color: u32,
    pad: u32,
}

struct VertexJoints {
    // 16 bits each.
    joints: vec2<u32>,
    weights: array<f32, 4>,
}

// camera_from_mesh, in cells.
struct CameraMatrix {
    rows: array<vec4<f32>, 3>,
}

struct DrawParams {
    base_color: vec4<f32>,
    first_index: u32,
    first_vertex: u32,
    first_matrix: u32,
    object: u32,
    // ALPHA_*.
    alpha_mode: u32,
    // Less alpha than this is not there, under ALPHA_MASK.
    cutoff: f32,
    unlit: u32,
    pad: u32,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> mesh: MeshParams;
@group(0) @binding(2) var<uniform> palette: Palette;
@group(0) @binding(3) var<uniform> draw: DrawParams;
@group(0) @binding(4) var<storage, read> indices: array<u32>;
@group(0) @binding(5) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(6) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(7) var<storage, read> matrices: array<CameraMatrix>;
@group(0) @binding(8) var base_color: texture_2d<f32>;
@group(0) @binding(9) var base_color_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tex_coord: vec2<f32>,
    @location(3) color: vec4<f32>,
}

struct Pixel {
    @location(0) color: vec4<f32>,
    @location(1) distance: vec4<f32>,
}

// sign(det)·cofactor: right for any scale, mirrored or not.
fn moved_normal(n: vec3<f32>, m: CameraMatrix) -> vec3<f32> {
    let c0 = cross(m.rows[1].xyz, m.rows[2].xyz);
    let c1 = cross(m.rows[2].xyz, m.rows[0].xyz);
    let c2 = cross(m.rows[0].xyz, m.rows[1].xyz);
    let moved = vec3<f32>(dot(c0, n), dot(c1, n), dot(c2, n));
    return select(moved, -moved, dot(m.rows[0].xyz, c0) < 0.0);
}

fn placed(v: MeshVertex, m: CameraMatrix) -> Vertex {
    let p = vec4<f32>(v.position, 1.0);
    let position = vec3<f32>(dot(m.rows[0], p), dot(m.rows[1], p), dot(m.rows[2], p));
    let normal = moved_normal(unpack_normal(v.normal), m);
    // Scaled once more, so that no cofactor of a small object vanishes in interpolation.
    let unit = normal * inverseSqrt(max(dot(normal, normal), 1e-37));
    return Vertex(mesh.clip_from_camera * vec4<f32>(position, 1.0), position, unit, v.tex_coord, unpack4x8unorm(v.color));
}

@vertex
fn rigid(@builtin(vertex_index) number: u32) -> Vertex {
    let vertex = draw.first_vertex + indices[draw.first_index + number];
    return placed(vertices[vertex], matrices[draw.first_matrix]);
}

@vertex
fn skinned(@builtin(vertex_index) number: u32) -> Vertex {
    let vertex = draw.first_vertex + indices[draw.first_index + number];
    let bound = vertex_joints[vertex];
    let joints = vec4<u32>(bound.joints.x & 0xffffu, bound.joints.x >> 16u, bound.joints.y & 0xffffu, bound.joints.y >> 16u);
    var sum = array<vec4<f32>, 3>();
    var total = 0.0;
    for (var i = 0u; i < 4u; i += 1u) {
        let weight = bound.weights[i];
        // A joint without weight is not even read: its matrix may be anything.
        if weight > 0.0 {
            let m = matrices[draw.first_matrix + joints[i]];
            sum = array(sum[0] + weight * m.rows[0], sum[1] + weight * m.rows[1], sum[2] + weight * m.rows[2]);
            total += weight;
        }
    }
    return placed(vertices[vertex], CameraMatrix(array(sum[0] / total, sum[1] / total, sum[2] / total)));
}

// 0 … 1 in an order that spreads: a share of pixels stands for a share of coverage.
fn threshold(pixel: vec2<u32>) -> f32 {
    let x = pixel.x ^ pixel.y;
    let order = ((x & 1u) << 3u) | ((pixel.y & 1u) << 2u) | ((x & 2u)) | ((pixel.y & 2u) >> 1u);
    return (f32(order) + 0.5) / 16.0;
}

// Transparency without an order: MASK by its cutoff, BLEND by a share of the pixels.
fn is_there(alpha: f32, pixel: vec2<u32>) -> bool {
    switch draw.alpha_mode {
        case ALPHA_MASK: { return alpha >= draw.cutoff; }
        case ALPHA_BLEND: { return alpha > threshold(pixel); }
        default: { return true; }
    }
}

@fragment
fn fragment(v: Vertex) -> Pixel {
    let surface = draw.base_color * v.color * textureSample(base_color, base_color_sampler, v.tex_coord);
    if !is_there(surface.a, vec2<u32>(v.clip.xy)) {
        discard;
    }
    let direction = normalize(v.position);
    var color = surface.rgb;
    if view.color_by == COLOR_OBJECT {
        color = palette.colors[draw.object & 255u].rgb;
    }
    if view.color_by == COLOR_NORMAL {
        color = linear_from_gamma(0.5 * normalize(mesh.world_from_camera * v.normal) + 0.5);
    } else if draw.unlit == 0u {
        color = headlight(color, v.normal, direction);
    }
    return Pixel(vec4<f32>(gamma_from_linear(color), 1.0), vec4<f32>(length(v.position), 0.0, 0.0, 1.0));
}
