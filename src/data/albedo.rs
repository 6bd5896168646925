//! How albedo is stored, shared by CPU and GPU; `shaders/shared/albedo.wgsl` is its mirror.
//!
//! ```text
//! voxels, vertices   r 8 | g 8 | b 8 | coverage or alpha 8     code c, albedo (c/255)²
//! leaves, nodes      r 10 | g 10 | b 10 | 2 unused             code c, albedo (c/1020)²
//! sums               units of 1/16256                          c²/4 of a voxel's code, rounded
//! ```
//!
//! A square root keeps the shade of dark colours where equal steps lose it, at half the precision of white. Sums count
//! in equal steps, so that a mean of light is one.

use super::packing::{unpack_position, unpack_rgba8};
use crate::gpu::{Constant, constants};

/// Code of 1 in leaves and nodes: four steps to one of a voxel's.
pub const ALBEDO_CODE_ONE: u32 = 1020;

pub const CONSTANTS: &[Constant] = constants![
    integer ALBEDO_CODE_ONE,
];

/// Albedo and coverage of a voxel, or colour and alpha of a vertex; rounds to nearest, clamps to [0, 1].
pub fn pack_color([r, g, b, a]: [f64; 4]) -> u32 {
    let byte = |value: f64| (value.clamp(0.0, 1.0) * 255.0).round() as u32;
    let [r, g, b] = [r, g, b].map(|value| byte(value.max(0.0).sqrt()));
    r | g << 8 | b << 16 | byte(a) << 24
}

/// Linear, and what stands beside it.
pub fn unpack_color(packed: u32) -> [f64; 4] {
    let [r, g, b, a] = unpack_rgba8(packed);
    [r * r, g * g, b * b, a]
}

/// What a voxel's code adds to a sum.
pub const fn units_of(code: u32) -> u32 {
    (code * code + 2) >> 2
}

/// The code of leaves that is nearest to a mean of units: 8·√units, rounded.
pub fn code_of(units: u32) -> u32 {
    // 8·√u ≥ c + ½ where 256·u ≥ (2c + 1)².
    let floor = (64 * units).isqrt();
    floor + u32::from(256 * units >= (2 * floor + 1) * (2 * floor + 1))
}

/// Linear albedo of a leaf or a node.
pub fn unpack_albedo(packed: u32) -> [f64; 3] {
    unpack_position(packed).map(|code| (f64::from(code) / f64::from(ALBEDO_CODE_ONE)).powi(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// White in a sum's units.
    const UNITS_ONE: u32 = units_of(255);

    #[test]
    fn dark_colours_keep_their_shade() {
        let dark = [0.0015, 0.003, 0.01, 0.25];
        let found = unpack_color(pack_color(dark));
        for (found, expected) in found.into_iter().zip(dark) {
            assert!((found / expected - 1.0).abs() < 0.05, "{found} instead of {expected}");
        }
        let bright = pack_color([1.0, 2.0, f64::NAN, 1.0]);
        assert_eq!(bright, 0xff00_ffff);
    }

    #[test]
    fn the_code_of_a_mean_is_the_nearest() {
        for units in 0..=UNITS_ONE {
            let exact = 8.0 * f64::from(units).sqrt();
            assert!((f64::from(code_of(units)) - exact).abs() <= 0.5, "{units}");
        }
        assert_eq!((code_of(0), code_of(UNITS_ONE)), (0, ALBEDO_CODE_ONE));
    }

    #[test]
    fn a_leaf_of_one_colour_has_that_colour() {
        for code in 0..=255_u32 {
            let off = code_of(units_of(code)).abs_diff(4 * code);
            assert!(off <= if code < 4 { 4 } else { 0 }, "{code} is {off} off");
        }
    }
}
