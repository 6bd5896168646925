// What a fragment's surface looks like: its material at the middle of its piece, averaged over as much of the textures
// as the piece covers. In: fragments as `voxelize/cover` leaves them. Out: the same with opacity, colour and
// normal.
#import shared/threads.wgsl
#import shared/triangle_list.wgsl
#import shared/fragments.wgsl
#import shared/surface_texture.wgsl
#import shared/emission.wgsl

struct SurfaceMaterial {
    base_color: vec4<f32>,
    // In units of the brightest of the scene.
    emissive: vec3<f32>,
    alpha_mode: u32,
    base_color_texture: SurfaceTexture,
    emissive_texture: SurfaceTexture,
    cutoff: f32,
    pad: array<u32, 3>,
}

@group(0) @binding(0) var<uniform> list: TriangleList;
@group(0) @binding(1) var<uniform> room: FragmentRoom;
@group(0) @binding(2) var<uniform> counts: FragmentCounts;
@group(0) @binding(3) var<storage, read> draws: array<TriangleDraw>;
@group(0) @binding(4) var<storage, read> indices: array<u32>;
@group(0) @binding(5) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(6) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(7) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(8) var<storage, read> materials: array<SurfaceMaterial>;
@group(0) @binding(9) var<storage, read> texels: array<u32>;
@group(0) @binding(10) var<storage, read_write> fragments: array<u32>;

var<private> draw: DrawParams;

override WORKGROUP_SIZE: u32 = 64u;

// A piece of a triangle: its vertices, its middle by their weights, its share of the triangle's area.
struct SurfacePiece {
    vertices: array<u32, 3>,
    weights: vec3<f32>,
    share: f32,
}

// Texture coordinates of the middle, and what the piece covers of the unit square.
fn footprint(piece: SurfacePiece, slot: TextureSlot) -> vec3<f32> {
    var uv = array<vec2<f32>, 3>();
    for (var i = 0u; i < 3u; i += 1u) {
        uv[i] = slot_uv(slot, vertices[piece.vertices[i]].tex_coords);
    }
    let middle = piece.weights.x * uv[0] + piece.weights.y * uv[1] + piece.weights.z * uv[2];
    let a = uv[1] - uv[0];
    let b = uv[2] - uv[0];
    return vec3<f32>(middle, 0.5 * abs(a.x * b.y - a.y * b.x) * piece.share);
}

// Colour, and which share of the piece is there.
fn base_color_of(piece: SurfacePiece, material: SurfaceMaterial) -> vec4<f32> {
    var vertex_color = vec4<f32>(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        vertex_color += piece.weights[i] * unpack_color(vertices[piece.vertices[i]].color);
    }
    let factor = material.base_color * vertex_color;
    let at = footprint(piece, material.base_color_texture.slot);
    if material.alpha_mode == ALPHA_MASK {
        let texel = sample_cut(material.base_color_texture, at.xy, at.z, factor.a, material.cutoff);
        // Shares are those without colours of vertices; what these cut out altogether is not there.
        return vec4<f32>(factor.rgb * texel.rgb, select(0.0, texel.a, factor.a >= material.cutoff));
    }
    let texel = sample_surface(material.base_color_texture, at.xy, at.z);
    return vec4<f32>(factor.rgb * texel.rgb, select(1.0, factor.a * texel.a, material.alpha_mode == ALPHA_BLEND));
}

fn emission_of(piece: SurfacePiece, material: SurfaceMaterial) -> vec3<f32> {
    let at = footprint(piece, material.emissive_texture.slot);
    return material.emissive * sample_surface(material.emissive_texture, at.xy, at.z).rgb;
}

fn normal_of(piece: SurfacePiece, owner: TriangleDraw) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let vertex = piece.vertices[i];
        sum += piece.weights[i] * unit_or_zero(moved_normal(vertices[vertex].normal, vertex_matrix(owner, vertex)));
    }
    return unit_or_zero(sum);
}

fn unit_or_zero(v: vec3<f32>) -> vec3<f32> {
    let largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if !(largest > 0.0) {
        return vec3<f32>(0.0);
    }
    return normalize(v / largest);
}

fn to_units(value: vec3<f32>, one: u32) -> vec3<u32> {
    return vec3<u32>(clamp(value, vec3<f32>(0.0), vec3<f32>(1.0)) * f32(one) + 0.5);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let number = thread_index(id, groups);
    if number >= threads.end || number >= min(counts.fragments, room.fragments) {
        return;
    }
    let start = fragment_start(number);
    let triangle = fragments[start + 2u];
    let is_of_batch = triangle >= list.first_triangle && triangle < list.end_triangle;
    if (fragments[start] & UNSHADED) == 0u || !is_of_batch {
        return;
    }
    let owner = entered_draw(triangle);
    let first = 3u * (triangle - owner.first_triangle);
    let second = unpack2x16unorm(fragments[start + 4u]);
    var piece = SurfacePiece();
    piece.vertices = array(vertex_of(first), vertex_of(first + 1u), vertex_of(first + 2u));
    piece.weights = vec3<f32>(1.0 - second.x - second.y, second);
    piece.share = bitcast<f32>(fragments[start + 5u]);
    let material = materials[owner.material];
    let base = clamp(base_color_of(piece, material), vec4<f32>(0.0), vec4<f32>(1.0));
    fragments[start] &= ~UNSHADED;
    fragments[start + 2u] = owner.object;
    fragments[start + 3u] |= u32(base.a * f32(OPACITY_ONE) + 0.5) << AREA_BITS;
    fragments[start + 4u] = pack_biased(to_units(sqrt(base.rgb), ALBEDO_CODE_ONE));
    fragments[start + 5u] = pack_normal(normal_of(piece, owner));
    if EMITS {
        let emission = pack_emission(to_units(emission_of(piece, material), EMISSION_MAX));
        fragments[start + 6u] = emission.x;
        fragments[start + 7u] = emission.y;
    }
}
