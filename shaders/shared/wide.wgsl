// 64-bit unsigned arithmetic on (low, high) pairs, for sums that outgrow a word.

fn wide_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn wide_sub(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(a.x - b.x, a.y - b.y - select(0u, 1u, a.x < b.x));
}

fn wide_less(a: vec2<u32>, b: vec2<u32>) -> bool {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

// Shift left by 0 to 31.
fn wide_shl(a: vec2<u32>, bits: u32) -> vec2<u32> {
    if bits == 0u {
        return a;
    }
    return vec2<u32>(a.x << bits, (a.y << bits) | (a.x >> (32u - bits)));
}

// s / w rounded half up, for quotients below 2^14; 0 < w < 2^49.
fn wide_rounded_quotient(s: vec2<u32>, w: vec2<u32>) -> u32 {
    let divisor = wide_shl(w, 1u);
    var rest = wide_add(wide_shl(s, 1u), w);
    var quotient = 0u;
    for (var bit = 14u; bit > 0u; bit -= 1u) {
        let step = wide_shl(divisor, bit - 1u);
        if !wide_less(rest, step) {
            rest = wide_sub(rest, step);
            quotient |= 1u << (bit - 1u);
        }
    }
    return quotient;
}

// Rounded: f32 holds 24 bits of it.
fn wide_to_float(a: vec2<u32>) -> f32 {
    return f32(a.y) * 4294967296.0 + f32(a.x);
}
