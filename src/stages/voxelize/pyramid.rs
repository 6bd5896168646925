//! Texture pyramids in linear light, for averages over a voxel's part of a surface.
//!
//! Level 0 is the file's image; level n+1 is the exact box filter of level n, odd sizes included.
//! Levels are 16-bit linear; a pyramid is made when first sampled, once per reading of an image.

use std::sync::OnceLock;

use glam::DVec2;

use crate::color::linear_from_gamma;
use crate::data::albedo::pack_color;
use crate::data::texels::Texels;
use crate::scene::{Texture, TextureRef, Wrap};
use crate::stages::textures::halve_ref::box_filtered;

/// The pyramids of all textures of a scene.
#[derive(Debug)]
pub struct TexturePyramids {
    textures: Vec<Pyramids>,
}

#[derive(Debug)]
struct Pyramids {
    texture: Texture,
    /// One for each of [`Texels`] that does not cut.
    levels: [OnceLock<Vec<Level>>; 3],
    /// By the least alpha byte.
    cuts: OnceLock<Box<[OnceLock<Vec<Level>>]>>,
}

/// Linear RGBA, 16 bits each, rows from the top; where alpha counts, colours are multiplied by it.
#[derive(Debug)]
struct Level {
    size: [usize; 2],
    texels: Vec<[u16; 4]>,
}

/// Levels of a texture, texels coded as voxels' colours are.
pub(super) struct CodedLevels {
    pub size: [usize; 2],
    pub first_level: usize,
    pub levels: Vec<([usize; 2], Vec<u32>)>,
}

impl TexturePyramids {
    /// Images are shared with `textures`, not copied.
    pub fn new(textures: &[Texture]) -> Self {
        let pyramids = |texture: &Texture| Pyramids {
            texture: texture.clone(),
            levels: Default::default(),
            cuts: OnceLock::new(),
        };
        Self { textures: textures.iter().map(pyramids).collect() }
    }

    /// Linear RGBA averaged over about `uv_area` (of the unit square) around `uv`; colours are not
    /// premultiplied. Opaque white where there is no such texture.
    pub fn sample(&self, texture: usize, texels: Texels, uv: DVec2, uv_area: f64) -> [f64; 4] {
        self.textures.get(texture).map_or([1.0; 4], |pyramids| pyramids.sample(texels, uv, uv_area))
    }

    /// The same of a mask's base colour, whose alpha says which share of the area is there. `is_there` decides by the
    /// alpha between texels of the file's image, for areas that are smaller than those; `least` is the smallest byte
    /// of which it is true.
    pub fn sample_cut(
        &self,
        texture: usize,
        least: u16,
        (uv, uv_area): (DVec2, f64),
        is_there: impl Fn(f64) -> bool,
    ) -> [f64; 4] {
        match self.textures.get(texture) {
            Some(pyramids) => pyramids.sample_cut(least, uv, uv_area, is_there),
            None => [1.0, 1.0, 1.0, f64::from(u8::from(is_there(1.0)))],
        }
    }

    /// Every level with no more than `most` texels along a side, and at least the last, for the GPU; `None` where there
    /// is no such texture. Level 0 of a mask is the file's image: its alpha is cut where it is read.
    pub(super) fn coded(&self, texture: usize, texels: Texels, most: usize) -> Option<CodedLevels> {
        let pyramids = self.textures.get(texture)?;
        let size = size_of(&pyramids.texture);
        if size.contains(&0) {
            return None;
        }
        let levels = pyramids.levels(texels);
        let size_at = |level: usize| if level == 0 { size } else { levels[level - 1].size };
        let first_level = (0..levels.len()).find(|&level| size_at(level).into_iter().all(|side| side <= most));
        let first_level = first_level.unwrap_or(levels.len());
        let finest = if matches!(texels, Texels::Cut { .. }) { Texels::Covering } else { texels };
        let coded = |level: usize| {
            let [width, height] = size_at(level);
            let texel = |i: usize| match level {
                0 => base_texel(&pyramids.texture, finest, i % width, i / width),
                _ => levels[level - 1].texel(i % width, i / width),
            };
            ([width, height], (0..width * height).map(|i| pack_color(texel(i))).collect())
        };
        Some(CodedLevels { size, first_level, levels: (first_level..=levels.len()).map(coded).collect() })
    }

    /// True where a slot is empty or its texture exists and has texels.
    pub(super) fn holds(&self, slot: Option<TextureRef>) -> bool {
        let has_texels = |pyramids: &Pyramids| size_of(&pyramids.texture).iter().all(|&n| n > 0);
        slot.is_none_or(|slot| self.textures.get(slot.texture).is_some_and(has_texels))
    }
}

impl Pyramids {
    fn levels(&self, texels: Texels) -> &[Level] {
        let build = || build_levels(&self.texture, texels);
        let of = |kept: usize| &self.levels[kept];
        match texels {
            Texels::Linear => of(0).get_or_init(build),
            Texels::Opaque => of(1).get_or_init(build),
            Texels::Covering => of(2).get_or_init(build),
            Texels::Cut { least } => {
                let cuts = self.cuts.get_or_init(|| (0..Texels::CUTS).map(|_| OnceLock::new()).collect());
                cuts[usize::from(least)].get_or_init(build)
            }
        }
    }

    /// Which level has texels of about `uv_area`.
    fn level_of(&self, levels: &[Level], uv_area: f64) -> f64 {
        let [width, height] = size_of(&self.texture);
        let texel_area = uv_area * width as f64 * height as f64;
        // `max` also turns the NaN of a degenerate mapping into the finest level.
        (0.5 * texel_area.log2()).max(0.0).min(levels.len() as f64)
    }

    fn sample(&self, texels: Texels, uv: DVec2, uv_area: f64) -> [f64; 4] {
        let levels = self.levels(texels);
        straight(texels, self.blended(levels, texels, uv, self.level_of(levels, uv_area)))
    }

    fn sample_cut(&self, least: u16, uv: DVec2, uv_area: f64, is_there: impl Fn(f64) -> bool) -> [f64; 4] {
        let cut = Texels::Cut { least };
        let levels = self.levels(cut);
        let level = self.level_of(levels, uv_area);
        // Between texels of the file's image alpha is blended before it is cut; shares are blended as they are.
        let finest = straight(Texels::Covering, self.sample_level(&[], 0, Texels::Covering, uv));
        let presence = f64::from(u8::from(is_there(finest[3])));
        let finest = [finest[0] * presence, finest[1] * presence, finest[2] * presence, presence];
        let coarse = self.blended(levels, cut, uv, level.max(1.0).min(levels.len() as f64));
        straight(cut, mix(finest, coarse, level.min(1.0)))
    }

    /// Between the two levels around one.
    fn blended(&self, levels: &[Level], texels: Texels, uv: DVec2, level: f64) -> [f64; 4] {
        let (fine, blend) = (level as usize, level.fract());
        let sum = self.sample_level(levels, fine, texels, uv);
        if blend > 0.0 { mix(sum, self.sample_level(levels, fine + 1, texels, uv), blend) } else { sum }
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
        mix(mix(fetch(x0, y0), fetch(x1, y0), tx), mix(fetch(x0, y1), fetch(x1, y1), tx), ty)
    }
}

fn mix(a: [f64; 4], b: [f64; 4], t: f64) -> [f64; 4] {
    std::array::from_fn(|c| a[c] + t * (b[c] - a[c]))
}

/// Colours as they are, of colours times alpha.
fn straight(texels: Texels, [r, g, b, alpha]: [f64; 4]) -> [f64; 4] {
    match texels {
        Texels::Covering | Texels::Cut { .. } if alpha > 0.0 => [r / alpha, g / alpha, b / alpha, alpha],
        _ => [r, g, b, alpha],
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
    if texels == Texels::Linear {
        return [r, g, b, a].map(|byte| f64::from(byte) / 255.0);
    }
    let presence = texels.presence(a);
    let [r, g, b] = [r, g, b].map(|byte| presence * srgb_to_linear(byte));
    [r, g, b, presence]
}

/// Levels 1 and up, to a single texel.
fn build_levels(texture: &Texture, texels: Texels) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let mut size = size_of(texture);
    while size != [1, 1] {
        let finer = levels.last();
        let (half, means) = box_filtered(size, |x, y| match finer {
            None => base_texel(texture, texels, x, y),
            Some(level) => level.texel(x, y),
        });
        let texels = means.map(|mean| mean.map(|value| (value * 65535.0).round() as u16)).collect();
        levels.push(Level { size: half, texels });
        size = half;
    }
    levels
}
