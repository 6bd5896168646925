//! Small procedural pictures as PNG bytes: tiles, plaster, brick, cloth, wood, roof.
//!
//! All repeat seamlessly and are at most 256 pixels wide. Colours are sRGB; those near white
//! are meant to be tinted by a material's factor.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageResult};

use super::exact::smoothstep;

/// A well-mixed number in 0 to 1 for a lattice point.
fn random(x: usize, y: usize, seed: u32) -> f64 {
    let mut bits = (x as u32).wrapping_mul(0x9E37_79B1) ^ (y as u32).wrapping_mul(0x85EB_CA77) ^ seed;
    for _ in 0..2 {
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2C1B_3C6D);
        bits = (bits ^ (bits >> 12)).wrapping_mul(0x297A_2D39);
    }
    f64::from(bits >> 8) / f64::from(1u32 << 24)
}

/// Smooth noise of `cells` lumps across the picture (u, v in 0 to 1), repeating.
fn noise(u: f64, v: f64, cells: usize, seed: u32) -> f64 {
    let (x, y) = (u * cells as f64, v * cells as f64);
    let (column, row) = (x as usize % cells, y as usize % cells);
    let (right, below) = ((column + 1) % cells, (row + 1) % cells);
    let (across, down) = (smoothstep(0.0, 1.0, x.fract()), smoothstep(0.0, 1.0, y.fract()));
    let top = random(column, row, seed) * (1.0 - across) + random(right, row, seed) * across;
    let bottom = random(column, below, seed) * (1.0 - across) + random(right, below, seed) * across;
    top * (1.0 - down) + bottom * down
}

/// Three octaves of [`noise`], 0 to 1.
fn cloud(u: f64, v: f64, cells: usize, seed: u32) -> f64 {
    let octave = |level: usize| noise(u, v, cells << level, seed + level as u32);
    (4.0 * octave(0) + 2.0 * octave(1) + octave(2)) / 7.0
}

/// Encodes a picture; `pixel` maps u, v in 0 to 1 to sRGB in 0 to 1.
pub fn png(width_px: u32, height_px: u32, pixel: impl Fn(f64, f64) -> [f64; 3]) -> ImageResult<Vec<u8>> {
    let mut rgb = Vec::with_capacity((width_px * height_px * 3) as usize);
    for y in 0..height_px {
        for x in 0..width_px {
            let color = pixel((f64::from(x) + 0.5) / f64::from(width_px), (f64::from(y) + 0.5) / f64::from(height_px));
            // Every second level only: noise hides it, and the file is a third smaller.
            rgb.extend(color.map(|channel| (channel.clamp(0.0, 1.0) * 127.0).round() as u8 * 2));
        }
    }
    let mut bytes = Vec::new();
    // `Fast` is fdeflate, whose output does not depend on which zlib the build picked or on the processor.
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive).write_image(
        &rgb,
        width_px,
        height_px,
        ExtendedColorType::Rgb8,
    )?;
    Ok(bytes)
}

fn mixed(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    std::array::from_fn(|channel| a[channel] + (b[channel] - a[channel]) * share)
}

fn tinted(color: [f64; 3], factor: f64) -> [f64; 3] {
    color.map(|channel| channel * factor)
}

/// Where a point lies in a `count` x `count` paving: cell, and the share of joint (0 to 1).
fn paving(u: f64, v: f64, count: usize, joint: f64) -> (usize, usize, f64) {
    let (x, y) = (u * count as f64, v * count as f64);
    let near = |t: f64| t.fract().min(1.0 - t.fract());
    let gap = 1.0 - smoothstep(joint * 0.6, joint, near(x).min(near(y)));
    (x as usize, y as usize, gap)
}

/// Squares of stone in two colours with a small dark stone at each crossing; 4 x 4 squares.
pub fn stone_tiles() -> ImageResult<Vec<u8>> {
    png(256, 256, |u, v| {
        let (column, row, gap) = paving(u, v, 4, 0.022);
        let light = (column + row).is_multiple_of(2);
        let base = if light { [0.84, 0.78, 0.68] } else { [0.70, 0.60, 0.49] };
        let vein = smoothstep(0.03, 0.0, (cloud(u, v, 6, 11) - 0.5).abs()) * 0.10;
        let shade = 0.90 + 0.10 * random(column, row, 5) + 0.08 * (cloud(u, v, 8, 3) - 0.5) - vein;
        let stone = tinted(base, shade);
        let color = if inlaid(u, v) { tinted([0.20, 0.25, 0.24], 0.9 + 0.3 * cloud(u, v, 12, 8)) } else { stone };
        mixed(color, [0.42, 0.37, 0.31], gap * if inlaid(u, v) { 0.0 } else { 0.8 })
    })
}

/// The little diamonds of [`stone_tiles`].
fn inlaid(u: f64, v: f64) -> bool {
    let near = |t: f64| (t * 4.0).fract().min(1.0 - (t * 4.0).fract());
    near(u) + near(v) < 0.17
}

/// Roughness (green) and metalness (blue) of [`stone_tiles`]: inlays polished, joints dull.
pub fn stone_tiles_roughness() -> ImageResult<Vec<u8>> {
    png(256, 256, |u, v| {
        let (column, row, gap) = paving(u, v, 4, 0.022);
        let stone = 0.22 + 0.10 * random(column, row, 9) + 0.9 * gap;
        [1.0, if inlaid(u, v) { 0.06 } else { stone.min(0.9) }, 0.0]
    })
}

/// Lime plaster, near white.
pub fn plaster() -> ImageResult<Vec<u8>> {
    png(128, 128, |u, v| {
        let blotch = 0.87 + 0.16 * (cloud(u, v, 3, 21) - 0.5) + 0.08 * (cloud(u, v, 16, 22) - 0.5);
        tinted([1.04, 1.02, 1.0], blotch)
    })
}

/// Travertine for columns and mouldings, near white, with faint layers.
pub fn travertine() -> ImageResult<Vec<u8>> {
    png(128, 128, |u, v| {
        let layer = cloud(u, (v + 0.06 * noise(u, v, 4, 32)).fract(), 4, 31) - 0.5;
        let pits = smoothstep(0.70, 0.90, noise((u * 2.0).fract(), (v * 5.0).fract(), 14, 33)) * 0.06;
        tinted([1.0, 0.985, 0.96], 0.93 + 0.14 * layer - pits)
    })
}

/// Bricks in running bond: 4 across, 12 courses.
pub fn brick() -> ImageResult<Vec<u8>> {
    png(256, 256, |u, v| {
        let course = (v * 12.0) as usize;
        let x = u * 4.0 + if course.is_multiple_of(2) { 0.0 } else { 0.5 };
        let (column, across, down) = (x as usize % 4, x.fract(), (v * 12.0).fract());
        let edge = (across.min(1.0 - across) * 3.0).min(down.min(1.0 - down));
        let mortar = smoothstep(0.12, 0.05, edge);
        let fired = random(column, course, 41);
        let clay = mixed([0.62, 0.36, 0.25], [0.74, 0.48, 0.33], fired);
        let color = tinted(clay, 0.92 + 0.2 * (cloud(u, v, 20, 42) - 0.5));
        mixed(color, [0.74, 0.69, 0.60], mortar)
    })
}

/// Woven cloth of one colour (sRGB) with a trim: border, lozenge and bands near the hem; v runs
/// downwards.
pub fn woven_banner(field: [f64; 3], trim: [f64; 3]) -> ImageResult<Vec<u8>> {
    png(128, 256, |u, v| {
        let thread = |t: f64, count: f64| ((t * count).fract() - 0.5).abs() * 2.0;
        let over = ((u * 32.0) as usize + (v * 64.0) as usize).is_multiple_of(2);
        let weave = 0.88 + 0.12 * if over { thread(u, 32.0) } else { thread(v, 64.0) };
        let side = u.min(1.0 - u);
        let border = (0.05..0.085).contains(&side);
        let band = (0.80..0.815).contains(&v) || (0.835..0.875).contains(&v) || (0.895..0.91).contains(&v);
        let lozenge = (u - 0.5).abs() * 1.6 + (v - 0.42).abs() * 2.4;
        let emblem = (0.26..0.33).contains(&lozenge) || lozenge < 0.13;
        let trimmed = emblem || border || (band && side > 0.05);
        tinted(if trimmed { trim } else { field }, weave)
    })
}

/// Planks along v, brown.
pub fn wood() -> ImageResult<Vec<u8>> {
    png(128, 128, |u, v| {
        let (plank, across) = ((u * 4.0) as usize, (u * 4.0).fract());
        let grain = noise((u + 0.02 * noise(u, v, 5, 51)).fract(), v, 48, 52) * 0.5 + cloud(u, v, 4, 53) * 0.5;
        let gap = smoothstep(0.05, 0.015, across.min(1.0 - across));
        tinted([0.52, 0.34, 0.20], (0.72 + 0.2 * random(plank, 0, 54) + 0.35 * (grain - 0.5)) * (1.0 - 0.7 * gap))
    })
}

/// Courses of roof tiles along v (4 to a repeat), each darker where the next one covers it.
pub fn roof_tiles() -> ImageResult<Vec<u8>> {
    png(128, 128, |u, v| {
        let (tile, course) = ((u * 4.0) as usize, (v * 4.0) as usize);
        let overlap = smoothstep(0.16, 0.0, (v * 4.0).fract());
        let clay = mixed([0.68, 0.36, 0.22], [0.80, 0.50, 0.33], random(tile, course, 61));
        tinted(clay, (0.95 + 0.25 * (cloud(u, v, 8, 62) - 0.5)) * (1.0 - 0.5 * overlap))
    })
}
