// One voxel through one matrix: position to q, normal by sign(det)·cofactor.
#import shared/world_voxel.wgsl
#import shared/part.wgsl

struct TransformParams {
    // N, cells along an axis.
    grid_cells: i32,
    // Threads before this pass' own: rigid parts come first in the work list, then skinned ones.
    first_thread: u32,
}

// grid_from_cache, row by row; the centre's half cell is folded into the translation on the CPU.
struct Matrix3x4 {
    rows: array<vec4<f32>, 3>,
}

fn move_position(position: vec3<f32>, m: Matrix3x4) -> vec3<f32> {
    return vec3<f32>(dot(m.rows[0].xyz, position) + m.rows[0].w, dot(m.rows[1].xyz, position) + m.rows[1].w, dot(m.rows[2].xyz, position) + m.rows[2].w);
}

fn move_normal(normal: vec3<f32>, m: Matrix3x4) -> vec3<f32> {
    let c0 = cross(m.rows[1].xyz, m.rows[2].xyz);
    let c1 = cross(m.rows[2].xyz, m.rows[0].xyz);
    let c2 = cross(m.rows[0].xyz, m.rows[1].xyz);
    let moved = vec3<f32>(dot(c0, normal), dot(c1, normal), dot(c2, normal));
    return select(moved, -moved, dot(m.rows[0].xyz, c0) < 0.0);
}

// q of a centre at `g` cells from the grid's corner (Eq. 2, converted once).
fn quantise(g: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor((g - 0.5) * f32(FRACTION_ONE) + 0.5));
}

// Whether the split of q leaves any weight inside the grid.
fn reaches_grid(q: vec3<i32>) -> bool {
    return all(q > vec3<i32>(-i32(FRACTION_ONE))) && all(base_cell(q) < vec3<i32>(params.grid_cells));
}

fn move_voxel(voxel: vec4<u32>, origin: vec3<i32>, m: Matrix3x4) -> vec4<u32> {
    let g = move_position(vec3<f32>(origin + vec3<i32>(unpack_position(voxel.x))), m);
    // Compared as floats first: far coordinates do not fit an integer q.
    if !(all(g > vec3<f32>(-2.0)) && all(g < vec3<f32>(f32(params.grid_cells) + 2.0))) {
        return vec4<u32>(OUTSIDE);
    }
    let q = quantise(g);
    if !reaches_grid(q) {
        return vec4<u32>(OUTSIDE);
    }
    let normal = pack_normal(move_normal(unpack_normal(voxel.y), m));
    return vec4<u32>(pack_q(q), normal, voxel.z);
}
