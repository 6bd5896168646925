//! The constants that Rust and WGSL share; a shader gets them by `#import constants`.

use crate::data::packing::NORMAL_MAX;
use crate::data::voxel_cache::TILE_CELLS;

/// Name in WGSL and value, taken from the Rust constant so that no number is written twice.
pub const CONSTANTS: &[(&str, u32)] = &[("NORMAL_MAX", NORMAL_MAX as u32), ("TILE_CELLS", TILE_CELLS as u32)];

/// One `const NAME: u32 = …;` a line.
pub fn wgsl() -> String {
    CONSTANTS.iter().map(|(name, value)| format!("const {name}: u32 = {value}u;\n")).collect()
}
