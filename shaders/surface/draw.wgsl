// The surface image: what the camera sees of the posed triangles, as data::surface_image lays it out. In:
// vertices by number, a matrix an object or joint (from mesh to the camera's axes, cells), the material's
// textures. Out: a texel a pixel. Entry points `rigid` and `skinned` differ in how a vertex moves.
#import shared/packing.wgsl
#import shared/octahedral.wgsl
#import shared/albedo.wgsl
#import shared/base_color.wgsl
#import shared/lens.wgsl

struct SurfaceParams {
    // From camera space in cells: x right, y up, z backward. Depth is reversed.
    clip_from_camera: mat4x4<f32>,
    world_from_camera: mat3x3<f32>,
    // Of an emissive factor of 1, nits.
    emission: f32,
    pad: u32,
    pad_2: vec2<u32>,
}

@group(0) @binding(0) var<uniform> surface: SurfaceParams;
@group(0) @binding(1) var<uniform> draw: DrawParams;
@group(0) @binding(2) var<storage, read> indices: array<u32>;
@group(0) @binding(3) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(4) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(5) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(6) var base_color: texture_2d<f32>;
@group(0) @binding(7) var base_color_sampler: sampler;
@group(0) @binding(8) var metallic_roughness: texture_2d<f32>;
@group(0) @binding(9) var metallic_roughness_sampler: sampler;
@group(0) @binding(10) var normal_map: texture_2d<f32>;
@group(0) @binding(11) var normal_sampler: sampler;
@group(0) @binding(12) var emissive: texture_2d<f32>;
@group(0) @binding(13) var emissive_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Bitangent: cross(normal, tangent) · w.
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coords: vec4<f32>,
    @location(4) color: vec4<f32>,
    // Of the triangle: its first vertex speaks for all three. By its winding, unit length.
    @location(5) @interpolate(flat, first) face: vec3<f32>,
    @location(6) @interpolate(flat, first) face_tangent: vec4<f32>,
    @location(7) @interpolate(flat, first) mirrored: u32,
}

struct Texel {
    @location(0) near: vec4<u32>,
    @location(1) stuff: vec4<u32>,
}

fn unit(v: vec3<f32>) -> vec3<f32> {
    return v * inverseSqrt(max(dot(v, v), 1e-37));
}

// The frame of the vertex itself.
fn placed(v: MeshVertex, m: MeshMatrix) -> Vertex {
    let position = moved_position(v.position, m);
    // Scaled once more, so that no cofactor of a small object vanishes in interpolation.
    let normal = unit(moved_normal(v.normal, m));
    let handed = select(1.0, -1.0, ((v.tangent & LEFT_HANDED) != 0u) != is_mirrored(m));
    let tangent = vec4<f32>(unit(moved_direction(unpack_normal(v.tangent), m)), handed);
    let clip = surface.clip_from_camera * vec4<f32>(position, 1.0);
    let color = unpack_color(v.color);
    let mirrored = u32(is_mirrored(m));
    return Vertex(clip, position, normal, tangent, v.tex_coords, color, vec3<f32>(0.0), vec4<f32>(0.0), mirrored);
}

// What the triangle's first vertex says for all: its normal by winding, and the way in which u of the
// normal map grows, with the sign that makes the bitangent point against v, which grows downwards.
fn faced(first: Vertex, edges: array<vec3<f32>, 2>, uv_edges: array<vec2<f32>, 2>) -> Vertex {
    var v = first;
    v.face = unit(cross(edges[0], edges[1]));
    let turn = sign(uv_edges[0].x * uv_edges[1].y - uv_edges[1].x * uv_edges[0].y);
    let along_u = turn * (edges[0] * uv_edges[1].y - edges[1] * uv_edges[0].y);
    v.face_tangent = vec4<f32>(unit(along_u), select(turn, -turn, dot(v.face, v.normal) >= 0.0));
    return v;
}

fn uv_edge(a: MeshVertex, b: MeshVertex) -> vec2<f32> {
    return slot_uv(draw.normal_slot, b.tex_coords) - slot_uv(draw.normal_slot, a.tex_coords);
}

@vertex
fn rigid(@builtin(vertex_index) number: u32) -> Vertex {
    let m = matrices[draw.first_matrix];
    let a = vertices[vertex_of(number)];
    let vertex = placed(a, m);
    if number % 3u != 0u {
        return vertex;
    }
    let b = vertices[vertex_of(number + 1u)];
    let c = vertices[vertex_of(number + 2u)];
    // Edges are moved, not corners: far from the eye those leave little of a small triangle.
    let edges = array(moved_direction(b.position - a.position, m), moved_direction(c.position - a.position, m));
    return faced(vertex, edges, array(uv_edge(a, b), uv_edge(a, c)));
}

@vertex
fn skinned(@builtin(vertex_index) number: u32) -> Vertex {
    let vertex_a = vertex_of(number);
    let a = vertices[vertex_a];
    let vertex = placed(a, skinned_matrix(vertex_a));
    if number % 3u != 0u {
        return vertex;
    }
    let vertex_b = vertex_of(number + 1u);
    let vertex_c = vertex_of(number + 2u);
    let b = vertices[vertex_b];
    let c = vertices[vertex_c];
    let edge_b = moved_position(b.position, skinned_matrix(vertex_b)) - vertex.position;
    let edge_c = moved_position(c.position, skinned_matrix(vertex_c)) - vertex.position;
    return faced(vertex, array(edge_b, edge_c), array(uv_edge(a, b), uv_edge(a, c)));
}

// The vertices' normal, turned by the normal map: in the frame of the vertex tangents, and without those in
// that of the triangle's texture coordinates. Coordinates without extent give no frame, and turn nothing.
fn mapped_normal(v: Vertex, normal: vec3<f32>) -> vec3<f32> {
    if draw.normal_slot.is_filled == 0u {
        return normal;
    }
    let texel = 2.0 * textureSample(normal_map, normal_sampler, slot_uv(draw.normal_slot, v.tex_coords)).xyz - 1.0;
    let given = select(v.face_tangent, v.tangent, draw.has_tangents != 0u);
    let across = given.xyz - dot(given.xyz, normal) * normal;
    let square = dot(across, across);
    if square < 1e-12 {
        return normal;
    }
    let tangent = across * inverseSqrt(square);
    let bitangent = cross(normal, tangent) * sign(given.w);
    let turned = draw.normal_scale * (texel.x * tangent + texel.y * bitangent) + texel.z * normal;
    return select(unit(turned), normal, dot(turned, turned) < 1e-12);
}

// On the side of the triangle that faces the eye, and never turned away from the eye: what lies below the
// horizon is moved towards the eye until its cosine is LEAST_EYE_COSINE.
fn shading_normal(v: Vertex, face: vec3<f32>, to_eye: vec3<f32>) -> vec3<f32> {
    let square = dot(v.normal, v.normal);
    let smooth_normal = select(v.normal * inverseSqrt(max(square, 1e-37)), face, square < 1e-12);
    let mapped = mapped_normal(v, smooth_normal);
    let normal = select(-mapped, mapped, dot(smooth_normal, face) >= 0.0);
    let lacking = max(LEAST_EYE_COSINE - dot(normal, to_eye), 0.0);
    return normalize(normal + lacking * to_eye);
}

@fragment
fn fragment(v: Vertex, @builtin(front_facing) is_front: bool) -> Texel {
    let base = base_color_at(v.color, slot_uv(draw.base_color_slot, v.tex_coords));
    if is_back(is_front, v.mirrored) || !is_there(base.presence, vec2<u32>(v.clip.xy)) {
        discard;
    }
    let to_eye = -direction_of_sight(surface.clip_from_camera, v.position);
    let face = select(-v.face, v.face, dot(v.face, to_eye) >= 0.0);
    let normal = shading_normal(v, face, to_eye);
    let share = textureSample(metallic_roughness, metallic_roughness_sampler, slot_uv(draw.metallic_roughness_slot, v.tex_coords)).gb;
    let glow = textureSample(emissive, emissive_sampler, slot_uv(draw.emissive_slot, v.tex_coords)).rgb;
    var albedo = base.color.rgb;
    var rough_metallic = vec2<f32>(draw.roughness, draw.metallic) * share;
    var emission = surface.emission * draw.emissive * glow;
    if draw.unlit != 0u {
        // Black metal: nothing is reflected (shared/brdf.wgsl).
        albedo = vec3<f32>(0.0);
        rough_metallic = vec2<f32>(1.0);
        emission = base.color.rgb;
    }
    let distance = bitcast<u32>(distance_seen(surface.clip_from_camera, v.position));
    let packed_normal = pack_octahedral(surface.world_from_camera * normal);
    let packed_face = pack_octahedral(surface.world_from_camera * face);
    let blue = pack2x16unorm(vec2<f32>(albedo.b, 0.0)) | pack4x8unorm(vec4<f32>(0.0, 0.0, rough_metallic));
    let near = vec4<u32>(distance, packed_normal, packed_face, pack2x16unorm(albedo.rg));
    return Texel(near, vec4<u32>(blue, bitcast<vec3<u32>>(emission)));
}
