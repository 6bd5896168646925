// A shadow map: distances of the posed triangles from a light, in cells along the map's axis. In:
// vertices by number, a matrix an object or joint (grid_from_mesh). Out: one layer. Entry points `rigid`
// and `skinned` as for pictures; MASK casts by its cutoff, BLEND by a share of the texels.
#import shared/posed_vertex.wgsl
#import shared/base_color.wgsl
#import shared/shadow_frame.wgsl

@group(0) @binding(0) var<uniform> frame: ShadowFrame;
@group(0) @binding(1) var<uniform> draw: DrawParams;
@group(0) @binding(2) var<storage, read> indices: array<u32>;
@group(0) @binding(3) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(4) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(5) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(6) var base_color: texture_2d<f32>;
@group(0) @binding(7) var base_color_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) distance: f32,
    @location(1) tex_coord: vec2<f32>,
    @location(2) alpha: f32,
    // Of the triangle: its first vertex speaks for all three.
    @location(3) @interpolate(flat, first) mirrored: u32,
}

fn placed(v: MeshVertex, m: MeshMatrix) -> Vertex {
    let p = vec4<f32>(moved_position(v.position, m), 1.0);
    let uv = slot_uv(draw.base_color_slot, v.tex_coords);
    let mirrored = u32(is_mirrored(m));
    return Vertex(frame.clip_from_grid * p, dot(frame.distance, p), uv, unpack4x8unorm(v.color).a, mirrored);
}

@fragment
fn fragment(v: Vertex, @builtin(front_facing) is_front: bool) -> @location(0) vec4<f32> {
    if is_back(is_front, v.mirrored) || !is_there(presence_at(v.alpha, v.tex_coord), vec2<u32>(v.clip.xy)) {
        discard;
    }
    return vec4<f32>(v.distance, 0.0, 0.0, 1.0);
}
