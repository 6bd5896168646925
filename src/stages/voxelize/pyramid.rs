//! Texture pyramids in linear light, for averages over a voxel's part of a surface.
//!
//! Level 0 is the file's image; level n+1 is the exact box filter of level n, odd sizes included.
//! Levels are 16-bit linear; a pyramid is made when first sampled, once per reading of an image.

use std::sync::OnceLock;

use glam::DVec2;

use crate::color::linear_from_gamma;
use crate::scene::{Texture, TextureRef, Wrap};

/// How a slot reads an image's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Texels {
    /// Numbers, such as metallic and roughness.
    Linear,
    /// sRGB colour; alpha says nothing.
    Opaque,
    /// sRGB colour weighted by alpha, so that what is invisible colours nothing.
    Covering,
}

/// The pyramids of all textures of a scene.
#[derive(Debug)]
pub struct TexturePyramids {
    textures: Vec<Pyramids>,
}

#[derive(Debug)]
struct Pyramids {
    texture: Texture,
    /// One for each of [`Texels`].
    levels: [OnceLock<Vec<Level>>; 3],
}

/// Linear RGBA, 16 bits each, rows from the top; for [`Texels::Covering`] premultiplied.
#[derive(Debug)]
struct Level {
    size: [usize; 2],
    texels: Vec<[u16; 4]>,
}

impl TexturePyramids {
    /// Images are shared with `textures`, not copied.
    pub fn new(textures: &[Texture]) -> Self {
        let pyramids = |texture: &Texture| Pyramids { texture: texture.clone(), levels: Default::default() };
        Self { textures: textures.iter().map(pyramids).collect() }
    }

    /// Linear RGBA averaged over about `uv_area` (of the unit square) around `uv`; colours are not
    /// premultiplied. Opaque white where there is no such texture.
    pub fn sample(&self, texture: usize, texels: Texels, uv: DVec2, uv_area: f64) -> [f64; 4] {
        self.textures.get(texture).map_or([1.0; 4], |pyramids| pyramids.sample(texels, uv, uv_area))
    }

    /// True where a slot is empty or its texture exists and has texels.
    pub(super) fn holds(&self, slot: Option<TextureRef>) -> bool {
        let has_texels = |pyramids: &Pyramids| size_of(&pyramids.texture).iter().all(|&n| n > 0);
        slot.is_none_or(|slot| self.textures.get(slot.texture).is_some_and(has_texels))
    }
}

impl Pyramids {
    fn sample(&self, texels: Texels, uv: DVec2, uv_area: f64) -> [f64; 4] {
        let levels = self.levels[texels as usize].get_or_init(|| build_levels(&self.texture, texels));
        let [width, height] = size_of(&self.texture);
        let texel_area = uv_area * width as f64 * height as f64;
        // `max` also turns the NaN of a degenerate mapping into the finest level.
        let lod = (0.5 * texel_area.log2()).max(0.0).min(levels.len() as f64);
        let (fine, blend) = (lod as usize, lod.fract());
        let mut sum = self.sample_level(levels, fine, texels, uv);
        if blend > 0.0 {
            let coarse = self.sample_level(levels, fine + 1, texels, uv);
            sum = std::array::from_fn(|c| sum[c] + blend * (coarse[c] - sum[c]));
        }
        if texels == Texels::Covering && sum[3] > 0.0 {
            for c in 0..3 {
                sum[c] /= sum[3];
            }
        }
        sum
    }

    fn sample_level(&self, levels: &[Level], level: usize, texels: Texels, uv: DVec2) -> [f64; 4] {
        let size = if level == 0 { size_of(&self.texture) } else { levels[level - 1].size };
        let fetch = |x, y| match level {
            0 => base_texel(&self.texture, texels, x, y),
            _ => levels[level - 1].texel(x, y),
        };
        let place = [0, 1].map(|axis| wrap(self.texture.wrap[axis], uv[axis]) * size[axis] as f64);
        if self.texture.nearest {
            let [x, y] = [0, 1].map(|axis| (place[axis] as usize).min(size[axis] - 1));
            return fetch(x, y);
        }
        let [(x0, x1, tx), (y0, y1, ty)] =
            [0, 1].map(|axis| neighbours(self.texture.wrap[axis], place[axis], size[axis]));
        let mix = |a: [f64; 4], b: [f64; 4], t: f64| std::array::from_fn(|c| a[c] + t * (b[c] - a[c]));
        mix(mix(fetch(x0, y0), fetch(x1, y0), tx), mix(fetch(x0, y1), fetch(x1, y1), tx), ty)
    }
}

impl Level {
    fn texel(&self, x: usize, y: usize) -> [f64; 4] {
        self.texels[y * self.size[0] + x].map(|value| f64::from(value) * (1.0 / 65535.0))
    }
}

fn size_of(texture: &Texture) -> [usize; 2] {
    [texture.image.width() as usize, texture.image.height() as usize]
}

/// A texture coordinate folded into [0, 1].
fn wrap(mode: Wrap, coordinate: f64) -> f64 {
    match mode {
        Wrap::Repeat => coordinate - coordinate.floor(),
        Wrap::MirroredRepeat => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
        Wrap::ClampToEdge => coordinate.clamp(0.0, 1.0),
    }
}

/// The two texels a place lies between, and how far along. A mirror shows the edge texel twice.
fn neighbours(mode: Wrap, place: f64, size: usize) -> (usize, usize, f64) {
    let from_centre = place - 0.5;
    let fraction = from_centre - from_centre.floor();
    let index = |i: i64| match mode {
        Wrap::Repeat => i.rem_euclid(size as i64) as usize,
        Wrap::MirroredRepeat | Wrap::ClampToEdge => i.clamp(0, size as i64 - 1) as usize,
    };
    let first = from_centre.floor() as i64;
    (index(first), index(first + 1), fraction)
}

fn srgb_to_linear(byte: u8) -> f64 {
    static TABLE: OnceLock<[f64; 256]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|i| linear_from_gamma(i as f64 / 255.0)))[usize::from(byte)]
}

fn base_texel(texture: &Texture, texels: Texels, x: usize, y: usize) -> [f64; 4] {
    let bytes = texture.image.as_raw();
    let start = 4 * (y * texture.image.width() as usize + x);
    let [r, g, b, a] = std::array::from_fn(|c| bytes[start + c]);
    let alpha = f64::from(a) / 255.0;
    match texels {
        Texels::Linear => [r, g, b, a].map(|byte| f64::from(byte) / 255.0),
        Texels::Opaque => {
            let [r, g, b] = [r, g, b].map(srgb_to_linear);
            [r, g, b, 1.0]
        }
        Texels::Covering => {
            let [r, g, b] = [r, g, b].map(|byte| alpha * srgb_to_linear(byte));
            [r, g, b, alpha]
        }
    }
}

/// Levels 1 and up, to a single texel.
fn build_levels(texture: &Texture, texels: Texels) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let mut size = size_of(texture);
    while size != [1, 1] {
        let next = match levels.last() {
            None => halve(size, |x, y| base_texel(texture, texels, x, y)),
            Some(level) => halve(size, |x, y| level.texel(x, y)),
        };
        size = next.size;
        levels.push(next);
    }
    levels
}

fn halve(size: [usize; 2], texel: impl Fn(usize, usize) -> [f64; 4]) -> Level {
    let half = size.map(|n| (n / 2).max(1));
    let columns: Vec<Vec<(usize, f64)>> = (0..half[0]).map(|x| footprint(x, size[0], half[0])).collect();
    let mut texels = Vec::with_capacity(half[0] * half[1]);
    for y in 0..half[1] {
        let rows = footprint(y, size[1], half[1]);
        for column in &columns {
            let mut sum = [0.0; 4];
            for &(sy, wy) in &rows {
                for &(sx, wx) in column {
                    let value = texel(sx, sy);
                    for c in 0..4 {
                        sum[c] += wx * wy * value[c];
                    }
                }
            }
            texels.push(sum.map(|value| (value * 65535.0).round() as u16));
        }
    }
    Level { size: half, texels }
}

/// Source texels under target texel `i`, and their shares, which sum to 1.
fn footprint(i: usize, size: usize, half: usize) -> Vec<(usize, f64)> {
    let scale = size as f64 / half as f64;
    let (from, to) = (i as f64 * scale, (i + 1) as f64 * scale);
    (from as usize..size.min(to.ceil() as usize))
        .map(|s| (s, (to.min((s + 1) as f64) - from.max(s as f64)) / scale))
        .filter(|&(_, share)| share > 0.0)
        .collect()
}
