// Fragments: a thread a column of a triangle finds the cells in it that the triangle covers, and what of the triangle
// lies in each: its area and its middle (Sutherland & Hodgman). In: posed triangles, their first columns. Out:
// fragments, each linked to the one before in its bucket. Their order differs between runs; no sum of them does.
#import shared/threads.wgsl
#import shared/column_scan.wgsl
#import shared/fragments.wgsl
#import shared/morton.wgsl

@group(0) @binding(0) var<uniform> list: TriangleList;
@group(0) @binding(1) var<uniform> room: FragmentRoom;
@group(0) @binding(2) var<storage, read> draws: array<TriangleDraw>;
@group(0) @binding(3) var<storage, read> indices: array<u32>;
@group(0) @binding(4) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(5) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(6) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(7) var<storage, read> starts: array<u32>;
@group(0) @binding(8) var<storage, read_write> heads: array<atomic<u32>>;
@group(0) @binding(9) var<storage, read_write> fragments: array<u32>;

var<private> draw: DrawParams;

override WORKGROUP_SIZE: u32 = 64u;

// Three corners, and one more for each of six planes.
const MAX_CORNERS: u32 = 9u;

// Points are kept as (s, t) = corner 0 + s · edge 1 + t · edge 2.
struct Polygon {
    corners: array<vec2<f32>, MAX_CORNERS>,
    count: u32,
}

struct Piece {
    // Share of the triangle's area.
    share: f32,
    middle: vec2<f32>,
}

// The part where offset + slope · p is not negative.
fn cut(part: ptr<function, Polygon>, offset: f32, slope: vec2<f32>) {
    var kept = Polygon();
    var last = vec2<f32>(0.0);
    if (*part).count > 0u {
        last = (*part).corners[(*part).count - 1u];
    }
    var last_distance = offset + dot(slope, last);
    for (var i = 0u; i < (*part).count; i += 1u) {
        let corner = (*part).corners[i];
        let distance = offset + dot(slope, corner);
        if (last_distance < 0.0) != (distance < 0.0) && kept.count < MAX_CORNERS {
            kept.corners[kept.count] = mix(last, corner, last_distance / (last_distance - distance));
            kept.count += 1u;
        }
        if distance >= 0.0 && kept.count < MAX_CORNERS {
            kept.corners[kept.count] = corner;
            kept.count += 1u;
        }
        last = corner;
        last_distance = distance;
    }
    *part = kept;
}

// Where rounding leaves no area, the area is zero and the middle the triangle's own.
fn measured(part: ptr<function, Polygon>) -> Piece {
    var share = 0.0;
    var middle = vec2<f32>(0.0);
    let first = (*part).corners[0];
    for (var i = 2u; i < (*part).count; i += 1u) {
        let a = (*part).corners[i - 1u] - first;
        let b = (*part).corners[i] - first;
        let fan = max(a.x * b.y - a.y * b.x, 0.0);
        share += fan;
        middle += fan * (a + b);
    }
    if !(share > 0.0) {
        return Piece(0.0, vec2<f32>(1.0 / 3.0));
    }
    return Piece(share, first + middle / (3.0 * share));
}

// What of the triangle lies in a cell (u, v, w).
fn piece_in(scan: ColumnScan, cell: vec3<f32>) -> Piece {
    var part = Polygon();
    part.corners[1] = vec2<f32>(1.0, 0.0);
    part.corners[2] = vec2<f32>(0.0, 1.0);
    part.count = 3u;
    let offset = scan.corners[0] - cell;
    let first = scan.corners[1] - scan.corners[0];
    let second = scan.corners[2] - scan.corners[0];
    let least = min(min(scan.corners[0], scan.corners[1]), scan.corners[2]);
    let most = max(max(scan.corners[0], scan.corners[1]), scan.corners[2]);
    for (var axis = 0u; axis < 3u; axis += 1u) {
        let slope = vec2<f32>(first[axis], second[axis]);
        if least[axis] < cell[axis] {
            cut(&part, offset[axis], slope);
        }
        if most[axis] > cell[axis] + 1.0 {
            cut(&part, 1.0 - offset[axis], -slope);
        }
    }
    return measured(&part);
}

fn triangle_of(column: u32) -> u32 {
    var low = list.first_triangle;
    var high = list.end_triangle;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if starts[middle] <= column {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// The middle's weights of the triangle's own second and third corner.
fn own_weights(scan: ColumnScan, middle: vec2<f32>) -> vec2<f32> {
    let sorted = vec3<f32>(max(1.0 - middle.x - middle.y, 0.0), middle);
    var own = vec3<f32>(0.0);
    own[scan.order[0]] = sorted.x;
    own[scan.order[1]] = sorted.y;
    own[scan.order[2]] = sorted.z;
    return own.yz;
}

fn add_fragment(scan: ColumnScan, cell: vec3<i32>, triangle: u32) {
    let number = atomicAdd(&heads[0], 1u);
    if number >= room.fragments {
        return;
    }
    let key = morton_key(vec3<u32>(from_uvw(cell, scan.axis)));
    let piece = piece_in(scan, vec3<f32>(cell));
    let area = 0.5 * length(scan.areas) * piece.share;
    let start = fragment_start(number);
    fragments[start] = key | UNSHADED;
    fragments[start + 1u] = atomicExchange(&heads[bucket_word(key)], number + 1u);
    fragments[start + 2u] = triangle;
    fragments[start + 3u] = clamp(u32(area * f32(AREA_ONE) + 0.5), 1u, (1u << AREA_BITS) - 1u);
    fragments[start + 4u] = pack2x16unorm(own_weights(scan, piece.middle));
    fragments[start + 5u] = bitcast<u32>(piece.share);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let column = thread_index(id, groups);
    if column >= threads.end || column < starts[list.first_triangle] || column >= starts[list.end_triangle] {
        return;
    }
    let triangle = triangle_of(column);
    let scan = posed_scan(triangle);
    let local = column - starts[triangle];
    let width = u32(scan.high.x - scan.low.x + 1);
    let place = scan.low.xy + vec2<i32>(vec2<u32>(local % width, local / width));
    let at = vec2<f32>(place);
    let is_sure = is_surely_inside(scan, at);
    if !is_sure && !column_reaches(scan, at) {
        return;
    }
    let layers = column_layers(scan, at);
    for (var layer = layers.x; layer <= layers.y; layer += 1) {
        let cell = vec3<i32>(place, layer);
        if is_sure || (CONSERVATIVE && scan.is_one_layer) || sides_reach(scan, vec3<f32>(cell)) {
            add_fragment(scan, cell, triangle);
        }
    }
}
