// Draws posed triangles with the camera, light and colours of the voxels. In: vertices by number, a
// matrix an object or joint. Out: as march. Entry points `rigid` and `skinned` differ in how a
// vertex moves; the second exists only where a scene has skins.
#import shared/view.wgsl
#import shared/posed_vertex.wgsl
#import shared/albedo.wgsl
#import shared/base_color.wgsl
#import shared/lens.wgsl

struct MeshParams {
    // From camera space in cells: x right, y up, z backward. Depth is reversed.
    clip_from_camera: mat4x4<f32>,
    world_from_camera: mat3x3<f32>,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> mesh: MeshParams;
@group(0) @binding(2) var<uniform> palette: Palette;
@group(0) @binding(3) var<uniform> draw: DrawParams;
@group(0) @binding(4) var<storage, read> indices: array<u32>;
@group(0) @binding(5) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(6) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(7) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(8) var base_color: texture_2d<f32>;
@group(0) @binding(9) var base_color_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tex_coord: vec2<f32>,
    @location(3) color: vec4<f32>,
    // Of the triangle: its first vertex speaks for all three.
    @location(4) @interpolate(flat, first) mirrored: u32,
}

struct Pixel {
    @location(0) color: vec4<f32>,
    @location(1) distance: vec4<f32>,
}

fn placed(v: MeshVertex, m: MeshMatrix) -> Vertex {
    let position = moved_position(v.position, m);
    let normal = moved_normal(v.normal, m);
    // Scaled once more, so that no cofactor of a small object vanishes in interpolation.
    let unit = normal * inverseSqrt(max(dot(normal, normal), 1e-37));
    let uv = slot_uv(draw.base_color_slot, v.tex_coords);
    let clip = mesh.clip_from_camera * vec4<f32>(position, 1.0);
    return Vertex(clip, position, unit, uv, unpack_color(v.color), u32(is_mirrored(m)));
}

@fragment
fn fragment(v: Vertex, @builtin(front_facing) is_front: bool) -> Pixel {
    let surface = base_color_at(v.color, v.tex_coord);
    if is_back(is_front, v.mirrored) || !is_there(surface.presence, vec2<u32>(v.clip.xy)) {
        discard;
    }
    let direction = direction_of_sight(mesh.clip_from_camera, v.position);
    var color = surface.color.rgb;
    if view.color_by == COLOR_OBJECT {
        color = palette.colors[draw.object & 255u].rgb;
    }
    if view.color_by == COLOR_NORMAL {
        color = linear_from_gamma(0.5 * normalize(mesh.world_from_camera * v.normal) + 0.5);
    } else if draw.unlit == 0u {
        color = headlight(color, v.normal, direction);
    }
    return Pixel(vec4<f32>(gamma_from_linear(color), 1.0), vec4<f32>(distance_seen(mesh.clip_from_camera, v.position), 0.0, 0.0, 1.0));
}
