//! Reference of `show_shadow.wgsl`: which texel of which layer a pixel shows.

/// Layer and texel; `None` beside the map.
pub fn texel(pixel: [u32; 2], size_px: [u32; 2], layers: u32, map_px: u32) -> Option<(u32, [u32; 2])> {
    let columns = layers.min(3);
    let rows = layers.div_ceil(3);
    let side = (size_px[0] / columns).min(size_px[1] / rows);
    let grid = [columns, rows];
    let at = [0, 1].map(|axis| {
        let corner = (size_px[axis] - side * grid[axis]) / 2;
        pixel[axis].checked_sub(corner).filter(|at| *at < side * grid[axis])
    });
    let [x, y] = [at[0]?, at[1]?];
    Some((x / side + columns * (y / side), [x % side * map_px / side, y % side * map_px / side]))
}

/// Where a distance lies on the scale, 0 to 1.
pub fn share(distance: f64, [least, most]: [f64; 2]) -> f64 {
    ((distance - least) / (most - least).max(1e-6)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_faces_lie_in_two_rows_amid_the_picture() {
        assert_eq!(texel([0, 0], [60, 60], 6, 20), None, "above two rows of 20");
        assert_eq!(texel([0, 10], [60, 60], 6, 20), Some((0, [0, 0])));
        assert_eq!(texel([59, 49], [60, 60], 6, 40), Some((5, [38, 38])));
        assert_eq!(texel([10, 0], [40, 20], 1, 20), Some((0, [0, 0])));
        assert_eq!(share(3.0, [1.0, 5.0]), 0.5);
    }
}
