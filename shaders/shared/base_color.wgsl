// The base colour of a fragment, and whether it is there. A shader declares `base_color` and
// `base_color_sampler` beside what shared/posed_mesh.wgsl asks for.
#import shared/posed_mesh.wgsl

struct BaseColor {
    // Linear; alpha as the material has it, however the surface is cut.
    color: vec4<f32>,
    // Share of the fragment's area that is there.
    presence: f32,
}

// The level whose texels are as large as the longer side of a fragment.
fn level_of(uv: vec2<f32>) -> f32 {
    let size = vec2<f32>(textureDimensions(base_color));
    let right = dpdx(uv) * size;
    let down = dpdy(uv) * size;
    let level = 0.5 * log2(max(max(dot(right, right), dot(down, down)), 1e-20));
    return clamp(level, 0.0, f32(textureNumLevels(base_color)) - 1.0);
}

// Of a mask that is `factor` times its texture's alpha: near, what is between texels is cut; from the first
// smaller level on, alpha is the share of texels that pass.
fn mask_presence(factor: f32, uv: vec2<f32>) -> f32 {
    let level = level_of(uv);
    let finest = textureSampleLevel(base_color, base_color_sampler, uv, 0.0).a;
    let share = textureSampleLevel(base_color, base_color_sampler, uv, max(level, 1.0)).a;
    let near = select(0.0, 1.0, factor * finest >= draw.cutoff);
    // Shares are those without colours of vertices; what these cut out altogether is not there.
    let far = select(0.0, share, factor >= draw.cutoff);
    return mix(near, far, min(level, 1.0));
}

// `vertex_color` multiplies it. In uniform control flow.
fn base_color_at(vertex_color: vec4<f32>, uv: vec2<f32>) -> BaseColor {
    let factor = draw.base_color * vertex_color;
    let color = factor * textureSample(base_color, base_color_sampler, uv);
    switch draw.alpha_mode {
        case ALPHA_MASK: { return BaseColor(color, mask_presence(factor.a, uv)); }
        case ALPHA_BLEND: { return BaseColor(color, color.a); }
        default: { return BaseColor(color, 1.0); }
    }
}

// The same of its presence alone: what is opaque reads no texture.
fn presence_at(vertex_alpha: f32, uv: vec2<f32>) -> f32 {
    let factor = draw.base_color.a * vertex_alpha;
    switch draw.alpha_mode {
        case ALPHA_MASK: { return mask_presence(factor, uv); }
        case ALPHA_BLEND: { return factor * textureSample(base_color, base_color_sampler, uv).a; }
        default: { return 1.0; }
    }
}

// 0 … 1 in an order that spreads: a share of pixels stands for a share of coverage, transparency without an order.
fn threshold(pixel: vec2<u32>) -> f32 {
    let x = pixel.x ^ pixel.y;
    let y = pixel.y;
    let coarse = ((x & 1u) << 5u) | ((y & 1u) << 4u) | ((x & 2u) << 2u) | ((y & 2u) << 1u);
    let order = coarse | ((x & 4u) >> 1u) | ((y & 4u) >> 2u);
    return (f32(order) + 0.5) / 64.0;
}

fn is_there(presence: f32, pixel: vec2<u32>) -> bool {
    return presence > threshold(pixel);
}
