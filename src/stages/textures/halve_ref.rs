//! Reference of halving: the box filter, in f64.

use crate::color::{gamma_from_linear, linear_from_gamma};
use crate::data::texels::Texels;

/// Width and height of the next level, and its texels, rows from the top: the mean of what each covers, odd sizes
/// included. Values are averaged as they are.
pub fn box_filtered(
    size: [usize; 2],
    texel: impl Fn(usize, usize) -> [f64; 4],
) -> ([usize; 2], impl Iterator<Item = [f64; 4]>) {
    let half = size.map(|n| (n / 2).max(1));
    let columns: Vec<Vec<(usize, f64)>> = (0..half[0]).map(|x| covered(x, size[0], half[0])).collect();
    let rows: Vec<Vec<(usize, f64)>> = (0..half[1]).map(|y| covered(y, size[1], half[1])).collect();
    let texels = (0..half[0] * half[1]).map(move |i| {
        let mut sum = [0.0; 4];
        for &(y, down) in &rows[i / half[0]] {
            for &(x, across) in &columns[i % half[0]] {
                let value = texel(x, y);
                for c in 0..4 {
                    sum[c] += across * down * value[c];
                }
            }
        }
        sum
    });
    (half, texels)
}

/// Finer texels under texel `i` along an axis, and their shares, which sum to 1.
fn covered(i: usize, size: usize, half: usize) -> Vec<(usize, f64)> {
    let scale = size as f64 / half as f64;
    let (from, to) = (i as f64 * scale, (i + 1) as f64 * scale);
    (from as usize..size.min(to.ceil() as usize))
        .map(|s| (s, (to.min((s + 1) as f64) - from.max(s as f64)) / scale))
        .filter(|&(_, share)| share > 0.0)
        .collect()
}

/// The next level of one that holds bytes, as shares of 255, before they are rounded. `is_first`: the finer level is
/// the file's image.
pub fn halve(size: [usize; 2], bytes: &[[u8; 4]], texels: Texels, is_first: bool) -> ([usize; 2], Vec<[f64; 4]>) {
    let value = |x: usize, y: usize| bytes[y * size[0] + x].map(|byte| f64::from(byte) / 255.0);
    let color = |channel: f64| if texels.are_colors() { linear_from_gamma(channel) } else { channel };
    let presence = |x: usize, y: usize| match texels {
        Texels::Cut { .. } if is_first => texels.presence(bytes[y * size[0] + x][3]),
        Texels::Covering | Texels::Cut { .. } => value(x, y)[3],
        Texels::Linear | Texels::Opaque => 1.0,
    };
    let (half, there) = box_filtered(size, |x, y| {
        let ([r, g, b, _], presence) = (value(x, y), presence(x, y));
        let [r, g, b] = [r, g, b].map(|channel| presence * color(channel));
        [r, g, b, presence]
    });
    let (_, all) = box_filtered(size, |x, y| {
        let [r, g, b, alpha] = value(x, y);
        [color(r), color(g), color(b), alpha]
    });
    let is_covering = matches!(texels, Texels::Covering | Texels::Cut { .. });
    let texel = |(there, all): ([f64; 4], [f64; 4])| {
        let mean: [f64; 3] =
            if there[3] > 0.0 { [0, 1, 2].map(|c| there[c] / there[3]) } else { [all[0], all[1], all[2]] };
        let [r, g, b] = mean.map(|channel| if texels.are_colors() { gamma_from_linear(channel) } else { channel });
        [r, g, b, if is_covering { there[3] } else { all[3] }]
    };
    (half, there.zip(all).map(texel).collect())
}
