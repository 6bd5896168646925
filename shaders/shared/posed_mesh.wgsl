// Posed triangles: vertices by number, the matrices that move them, and what of a surface is there. A
// shader declares `draw`, `indices`, `vertices`, `vertex_joints` and `matrices`.
#import constants

struct MeshVertex {
    position: vec3<f32>,
    // Linear, 8 bits each.
    color: u32,
    normal: vec3<f32>,
    // Packed, and LEFT_HANDED.
    tangent: u32,
    // TEXCOORD_0 and TEXCOORD_1.
    tex_coords: vec4<f32>,
}

struct VertexJoints {
    // 16 bits each.
    joints: vec2<u32>,
    weights: array<f32, 4>,
}

// From mesh to the space that the picture is taken in, cells, row by row.
struct MeshMatrix {
    rows: array<vec4<f32>, 3>,
}

// Where a material's texture is read: u and v are dot products with (tex_coord, 1).
struct TextureSlot {
    u: vec3<f32>,
    // 0 or 1: which TEXCOORD_n.
    tex_coord: u32,
    v: vec3<f32>,
    is_filled: u32,
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
    has_tangents: u32,
    emissive: vec3<f32>,
    normal_scale: f32,
    roughness: f32,
    metallic: f32,
    // Only the side from which its corners go round against the clock is there.
    single_sided: u32,
    pad: u32,
    base_color_slot: TextureSlot,
    metallic_roughness_slot: TextureSlot,
    normal_slot: TextureSlot,
    emissive_slot: TextureSlot,
}

fn slot_uv(slot: TextureSlot, tex_coords: vec4<f32>) -> vec2<f32> {
    let at = vec3<f32>(select(tex_coords.xy, tex_coords.zw, slot.tex_coord == 1u), 1.0);
    return vec2<f32>(dot(slot.u, at), dot(slot.v, at));
}

// sign(det)·cofactor: right for any scale, mirrored or not.
fn moved_normal(n: vec3<f32>, m: MeshMatrix) -> vec3<f32> {
    let c0 = cross(m.rows[1].xyz, m.rows[2].xyz);
    let c1 = cross(m.rows[2].xyz, m.rows[0].xyz);
    let c2 = cross(m.rows[0].xyz, m.rows[1].xyz);
    let moved = vec3<f32>(dot(c0, n), dot(c1, n), dot(c2, n));
    return select(moved, -moved, is_mirrored(m));
}

fn moved_position(position: vec3<f32>, m: MeshMatrix) -> vec3<f32> {
    let p = vec4<f32>(position, 1.0);
    return vec3<f32>(dot(m.rows[0], p), dot(m.rows[1], p), dot(m.rows[2], p));
}

fn moved_direction(d: vec3<f32>, m: MeshMatrix) -> vec3<f32> {
    return vec3<f32>(dot(m.rows[0].xyz, d), dot(m.rows[1].xyz, d), dot(m.rows[2].xyz, d));
}

fn is_mirrored(m: MeshMatrix) -> bool {
    return dot(m.rows[0].xyz, cross(m.rows[1].xyz, m.rows[2].xyz)) < 0.0;
}

// The back of a single-sided surface is nowhere: not for the eye, not for a light. `mirrored`: 1 where the matrix of
// the triangle turns its winding round.
fn is_back(is_front_by_winding: bool, mirrored: u32) -> bool {
    return draw.single_sided != 0u && is_front_by_winding == (mirrored != 0u);
}

// Which vertex corner `number` of the drawn triangles is.
fn vertex_of(number: u32) -> u32 {
    return draw.first_vertex + indices[draw.first_index + number];
}

// The matrices of up to four joints, blended by weight.
fn skinned_matrix(vertex: u32) -> MeshMatrix {
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
    return MeshMatrix(array(sum[0] / total, sum[1] / total, sum[2] / total));
}

