//! Reference of `count_luminance.wgsl`: how many pixels that show a surface and are not black are in each bin.

use super::count_luminance::{LUMINANCE_BIN_SHIFT, LUMINANCE_BINS};
use crate::color::luminance;

pub fn counts(shown: &[[f32; 4]]) -> Vec<u32> {
    let mut counts = vec![0; LUMINANCE_BINS as usize];
    let of_pixel = |[r, g, b, _]: [f32; 4]| luminance([r, g, b].map(f64::from)) as f32;
    let lit = shown.iter().filter(|pixel| pixel[3] > 0.0).map(|pixel| of_pixel(*pixel)).filter(|light| *light > 0.0);
    lit.for_each(|light| counts[(light.to_bits() >> LUMINANCE_BIN_SHIFT).min(LUMINANCE_BINS - 1) as usize] += 1);
    counts
}
