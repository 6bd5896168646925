// A world voxel, 16 bytes: what transformation leaves for every later stage (section 4.2).
//
//   word 0  qx 19 | qy low 13        q + 256 = 256·(cell + 1) + fraction, per axis: the guard layer
//   word 1  qy high 6 | qz 19        of one cell keeps base −1 representable
//   word 2  normal, packed           word 3  albedo r 8 | g 8 | b 8 | coverage 8
//
// One quotient, then cell and fraction of that same number (Eq. 2): q >> 8 and q & 255.
#import constants
#import shared/packing.wgsl

const OUTSIDE: u32 = 0xffffffffu;

fn pack_q(q: vec3<i32>) -> vec2<u32> {
    let biased = vec3<u32>(q + vec3<i32>(i32(FRACTION_ONE)));
    return vec2<u32>(biased.x | ((biased.y & 0x1fffu) << 19u), (biased.y >> 13u) | (biased.z << 6u));
}

fn unpack_q(words: vec2<u32>) -> vec3<i32> {
    let biased = vec3<u32>(words.x & 0x7ffffu, (words.x >> 19u) | ((words.y & 0x3fu) << 13u), (words.y >> 6u) & 0x7ffffu);
    return vec3<i32>(biased) - vec3<i32>(i32(FRACTION_ONE));
}

// A slot without a voxel, which has no weight that could be lost.
fn is_no_voxel(voxel: vec4<u32>) -> bool {
    return all(voxel.xy == vec2<u32>(NO_VOXEL));
}

// A slot without a voxel in the grid.
fn is_nowhere(voxel: vec4<u32>) -> bool {
    return voxel.x == OUTSIDE || is_no_voxel(voxel);
}

fn base_cell(q: vec3<i32>) -> vec3<i32> {
    return q >> vec3<u32>(FRACTION_BITS);
}

fn fraction(q: vec3<i32>) -> vec3<u32> {
    return vec3<u32>(q) & vec3<u32>(FRACTION_ONE - 1u);
}

fn nearest_cell(q: vec3<i32>) -> vec3<i32> {
    return (q + vec3<i32>(i32(FRACTION_ONE / 2u))) >> vec3<u32>(FRACTION_BITS);
}

// What a voxel's surface leaves free of its cell, 256ths: never all of it. `color` is word 3.
fn uncovered(color: u32) -> u32 {
    let coverage = color >> 24u;
    return FRACTION_ONE - max(coverage + (coverage >> 7u), 1u);
}

// The part of a weight (up to 2^24) that counts; nothing that had weight loses all of it.
fn covered_weight(weight: u32, uncovered: u32) -> u32 {
    return weight - ((weight * uncovered) >> FRACTION_BITS);
}
