//! Reference of `glossy_tiles`: tiles of 8 x 8 pixels, row by row, that hold a pixel with a specular cone.

use super::TILE_PX;

/// `is_glossy`: of every pixel, rows from the top.
pub fn glossy_tiles(is_glossy: &[bool], [width, height]: [u32; 2]) -> Vec<bool> {
    let tiles = (0..height.div_ceil(TILE_PX)).flat_map(|y| (0..width.div_ceil(TILE_PX)).map(move |x| (x, y)));
    let side = |tile: u32, end: u32| tile * TILE_PX..((tile + 1) * TILE_PX).min(end);
    let holds = |(x, y): (u32, u32)| {
        side(y, height).any(|row| side(x, width).any(|column| is_glossy[(row * width + column) as usize]))
    };
    tiles.map(holds).collect()
}
