// Textures as voxelization reads them: levels in linear light, averages over a part of a surface. The levels lie one
// after the other in `texels`, which a kernel declares: first where each begins and its size, then the texels,
// coded as voxels' colours are; where alpha counts, colours are multiplied by it.
#import constants
#import shared/albedo.wgsl
#import shared/posed_mesh.wgsl

struct SurfaceTexture {
    // Not filled: white.
    slot: TextureSlot,
    // Of the file's image.
    size: vec2<u32>,
    // The finest level that is there: others have more texels than the grid has cells.
    first_level: u32,
    // One behind the last.
    end_level: u32,
    // WRAP_*.
    wrap: vec2<u32>,
    nearest: u32,
    is_covering: u32,
    // Where the list of levels begins.
    first_word: u32,
    pad: array<u32, 3>,
}

struct TextureLevel {
    first_word: u32,
    size: vec2<u32>,
}

fn texture_level(surface: SurfaceTexture, level: u32) -> TextureLevel {
    let word = surface.first_word + 2u * (level - surface.first_level);
    let size = texels[word + 1u];
    return TextureLevel(texels[word], vec2<u32>(size & 0xffffu, size >> 16u));
}

fn wrapped(wrap: u32, coordinate: f32) -> f32 {
    switch wrap {
        case WRAP_REPEAT: { return coordinate - floor(coordinate); }
        case WRAP_MIRRORED: { return 1.0 - abs(coordinate - 2.0 * floor(coordinate / 2.0) - 1.0); }
        default: { return clamp(coordinate, 0.0, 1.0); }
    }
}

// A texel's number along an axis; a mirror shows the edge texel twice.
fn texel_number(wrap: u32, number: i32, size: u32) -> u32 {
    if wrap == WRAP_REPEAT {
        return u32((number + i32(size)) % i32(size));
    }
    return u32(clamp(number, 0, i32(size) - 1));
}

fn sample_level(surface: SurfaceTexture, number: u32, uv: vec2<f32>) -> vec4<f32> {
    let level = texture_level(surface, number);
    let place = vec2<f32>(wrapped(surface.wrap.x, uv.x), wrapped(surface.wrap.y, uv.y)) * vec2<f32>(level.size);
    if surface.nearest != 0u {
        let at = min(vec2<u32>(place), level.size - 1u);
        return unpack_color(texels[level.first_word + at.y * level.size.x + at.x]);
    }
    let from_centre = place - 0.5;
    let first = vec2<i32>(floor(from_centre));
    let share = from_centre - floor(from_centre);
    var sum = vec4<f32>(0.0);
    for (var corner = 0u; corner < 4u; corner += 1u) {
        let offset = vec2<u32>(corner & 1u, corner >> 1u);
        let x = texel_number(surface.wrap.x, first.x + i32(offset.x), level.size.x);
        let y = texel_number(surface.wrap.y, first.y + i32(offset.y), level.size.y);
        let weight = select(1.0 - share, share, offset == vec2<u32>(1u));
        sum += weight.x * weight.y * unpack_color(texels[level.first_word + y * level.size.x + x]);
    }
    return sum;
}

// Between the two levels around one.
fn sample_between(surface: SurfaceTexture, level: f32, uv: vec2<f32>) -> vec4<f32> {
    let fine = u32(level);
    let sum = sample_level(surface, fine, uv);
    let blend = fract(level);
    if blend == 0.0 {
        return sum;
    }
    return mix(sum, sample_level(surface, fine + 1u, uv), blend);
}

// Which level has texels of about `uv_area`.
fn level_for(surface: SurfaceTexture, uv_area: f32) -> f32 {
    let size = vec2<f32>(surface.size);
    let level = 0.5 * log2(max(uv_area * size.x * size.y, 1e-30));
    return clamp(level, f32(surface.first_level), f32(surface.end_level - 1u));
}

fn straight(surface: SurfaceTexture, color: vec4<f32>) -> vec4<f32> {
    if surface.is_covering != 0u && color.a > 0.0 {
        return vec4<f32>(color.rgb / color.a, color.a);
    }
    return color;
}

// Linear, averaged over about `uv_area` of the unit square.
fn sample_surface(surface: SurfaceTexture, uv: vec2<f32>, uv_area: f32) -> vec4<f32> {
    if surface.slot.is_filled == 0u {
        return vec4<f32>(1.0);
    }
    return straight(surface, sample_between(surface, level_for(surface, uv_area), uv));
}

// The same of a mask that is `factor` times its texture's alpha, whose alpha then is the share that is there.
fn sample_cut(surface: SurfaceTexture, uv: vec2<f32>, uv_area: f32, factor: f32, cutoff: f32) -> vec4<f32> {
    if surface.slot.is_filled == 0u {
        return vec4<f32>(1.0);
    }
    let level = level_for(surface, uv_area);
    if level >= 1.0 {
        return straight(surface, sample_between(surface, level, uv));
    }
    // Between texels of the file's image alpha is blended before it is cut; shares are blended as they are.
    let finest = straight(surface, sample_level(surface, 0u, uv));
    let presence = select(0.0, 1.0, factor * finest.a >= cutoff);
    let near = vec4<f32>(finest.rgb * presence, presence);
    if surface.end_level == 1u {
        return straight(surface, near);
    }
    return straight(surface, mix(near, sample_level(surface, 1u, uv), level));
}
