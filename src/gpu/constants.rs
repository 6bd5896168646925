//! The constants that Rust and WGSL share; a shader gets them by `#import constants`.

use crate::data::octree::{ALBEDO_NODE_SCALE, FRACTION_BITS, FULL_WEIGHT, MAX_FRAGMENTS, NO_BLOCK};
use crate::data::packing::NORMAL_MAX;
use crate::data::pages::WORK_HINT_THREADS;
use crate::data::voxel_cache::TILE_CELLS;
use crate::stages::build::scan::SCAN_CHUNK;
use crate::stages::build::{COUNTER_CLIPPED, COUNTER_OCCUPIED};

/// Name in WGSL and value, taken from the Rust constant so that no number is written twice.
pub const CONSTANTS: &[(&str, u32)] = &[
    ("ALBEDO_NODE_SCALE", ALBEDO_NODE_SCALE),
    ("COUNTER_CLIPPED", COUNTER_CLIPPED),
    ("COUNTER_OCCUPIED", COUNTER_OCCUPIED),
    ("FRACTION_BITS", FRACTION_BITS),
    ("FRACTION_ONE", 1 << FRACTION_BITS),
    ("FULL_WEIGHT", FULL_WEIGHT),
    ("MAX_FRAGMENTS", MAX_FRAGMENTS),
    ("NORMAL_MAX", NORMAL_MAX as u32),
    ("NO_BLOCK", NO_BLOCK),
    ("SCAN_CHUNK", SCAN_CHUNK),
    ("TILE_CELLS", TILE_CELLS as u32),
    ("WORK_HINT_THREADS", WORK_HINT_THREADS),
];

/// One `const NAME: u32 = …;` a line.
pub fn wgsl() -> String {
    CONSTANTS.iter().map(|(name, value)| format!("const {name}: u32 = {value}u;\n")).collect()
}
