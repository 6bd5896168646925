// A mip level: each texel the mean of what it covers of the level before, colours in linear light, odd sizes
// included. In: a level. Out: the next one, half as large. A thread a texel.
#import constants
#import shared/gamma.wgsl
#import shared/threads.wgsl

struct HalveParams {
    // Of the next level.
    size: vec2<u32>,
    // Red, green and blue are sRGB.
    are_colors: u32,
    // Colours weigh by alpha.
    is_covering: u32,
    // A texel with this alpha, of 255, is there, one with less is not; CUTS_NOTHING: alpha says how much of it is.
    least_alpha: u32,
    pad: u32,
}

@group(0) @binding(0) var<uniform> params: HalveParams;
@group(0) @binding(1) var finer: texture_2d<f32>;
@group(0) @binding(2) var halved: texture_storage_2d<rgba8unorm, write>;

override WORKGROUP_SIZE: u32 = 64u;

// Texels from .x to before .y of the finer level lie under texel `at`, along an axis.
fn covered(at: u32, finer_size: u32, size: u32) -> vec2<u32> {
    return vec2<u32>(at * finer_size / size, ((at + 1u) * finer_size + size - 1u) / size);
}

// Which share of texel `at` the texel `part` of the finer level is: exact in integers but for the last division.
fn share(at: u32, part: u32, finer_size: u32, size: u32) -> f32 {
    let end = min((at + 1u) * finer_size, (part + 1u) * size);
    let start = max(at * finer_size, part * size);
    return f32(end - start) / f32(finer_size);
}

fn presence(alpha: f32) -> f32 {
    if params.is_covering == 0u {
        return 1.0;
    }
    if params.least_alpha == CUTS_NOTHING {
        return alpha;
    }
    return select(0.0, 1.0, u32(255.0 * alpha + 0.5) >= params.least_alpha);
}

fn mean(at: vec2<u32>) -> vec4<f32> {
    let finer_size = textureDimensions(finer);
    let columns = covered(at.x, finer_size.x, params.size.x);
    let rows = covered(at.y, finer_size.y, params.size.y);
    // Colours of what is there, all colours, and what is there of alpha.
    var there = vec3<f32>(0.0);
    var all_colors = vec3<f32>(0.0);
    var alpha = 0.0;
    var weight = 0.0;
    for (var y = rows.x; y < rows.y; y += 1u) {
        for (var x = columns.x; x < columns.y; x += 1u) {
            let texel = textureLoad(finer, vec2<u32>(x, y), 0);
            let part = share(at.x, x, finer_size.x, params.size.x) * share(at.y, y, finer_size.y, params.size.y);
            let color = select(texel.rgb, linear_from_gamma(texel.rgb), params.are_colors != 0u);
            let present = part * presence(texel.a);
            there += present * color;
            all_colors += part * color;
            weight += present;
            alpha += select(part * texel.a, present, params.is_covering != 0u);
        }
    }
    // Where nothing is there, its colour is as good as any.
    return vec4<f32>(select(all_colors, there / max(weight, 1e-9), weight > 0.0), alpha);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = thread_index(id, groups);
    if i >= threads.end {
        return;
    }
    let at = vec2<u32>(i % params.size.x, i / params.size.x);
    let texel = mean(at);
    let color = select(texel.rgb, gamma_from_linear(texel.rgb), params.are_colors != 0u);
    textureStore(halved, at, vec4<f32>(color, texel.a));
}
