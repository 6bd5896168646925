// 64-bit unsigned arithmetic on (low, high) pairs, for sums that outgrow a word.

fn wide_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn wide_sub(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(a.x - b.x, a.y - b.y - select(0u, 1u, a.x < b.x));
}

// Shift left by 0 to 31.
fn wide_shl(a: vec2<u32>, bits: u32) -> vec2<u32> {
    if bits == 0u {
        return a;
    }
    return vec2<u32>(a.x << bits, (a.y << bits) | (a.x >> (32u - bits)));
}

// For factors below 2^16.
fn wide_times(a: vec2<u32>, factor: u32) -> vec2<u32> {
    let low = (a.x & 0xffffu) * factor;
    let high = (a.x >> 16u) * factor + (low >> 16u);
    return vec2<u32>((high << 16u) | (low & 0xffffu), a.y * factor + (high >> 16u));
}

// Rounded: f32 holds 24 bits of it.
fn wide_to_float(a: vec2<u32>) -> f32 {
    return f32(a.y) * 4294967296.0 + f32(a.x);
}

// s / w rounded half up, for quotients below 2^14 and 0 < w < 2^49: a float guess, then perhaps one step up.
fn wide_mean(s: vec2<u32>, w: vec2<u32>) -> u32 {
    // The guess is off by less than 1/100, so its floor never exceeds the rounded quotient.
    let quotient = u32(floor(wide_to_float(s) / wide_to_float(w)));
    let rest = wide_sub(s, wide_times(w, quotient));
    // Its sign says on which side of a half the rest lies.
    let beyond = wide_sub(wide_add(rest, rest), w);
    return quotient + 1u - (beyond.y >> 31u);
}
