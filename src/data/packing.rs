//! Bit packing shared by CPU and GPU; `shaders/shared/packing.wgsl` is its mirror.

use glam::DVec3;

use crate::gpu::{Constant, constants};

/// Largest magnitude of a packed normal component: 10 bits, signed, symmetric.
pub const NORMAL_MAX: i32 = 511;

pub const CONSTANTS: &[Constant] = constants![
    integer NORMAL_MAX = NORMAL_MAX as u32,
];

/// Packs a normal as three biased 10-bit integers (x lowest), so that sums of normals are sums of
/// unsigned integers. A zero or non-finite vector packs as zero length.
pub fn pack_normal(normal: DVec3) -> u32 {
    let unit = normal.normalize_or_zero();
    let biased = |component: f64| ((component * f64::from(NORMAL_MAX)).round() as i32 + NORMAL_MAX) as u32;
    biased(unit.x) | biased(unit.y) << 10 | biased(unit.z) << 20
}

pub fn unpack_normal(packed: u32) -> DVec3 {
    let component = |shift: u32| f64::from((packed >> shift & 0x3ff) as i32 - NORMAL_MAX) / f64::from(NORMAL_MAX);
    DVec3::new(component(0), component(10), component(20))
}

/// Three cache coordinates of 10 bits each (section 4.2), x lowest.
pub fn pack_position(cell: [u32; 3]) -> u32 {
    debug_assert!(cell.iter().all(|&c| c < 1024));
    cell[0] | cell[1] << 10 | cell[2] << 20
}

pub fn unpack_position(packed: u32) -> [u32; 3] {
    [packed & 0x3ff, packed >> 10 & 0x3ff, packed >> 20 & 0x3ff]
}

/// RGBA, 8 bits each, R lowest; rounds to nearest, clamps to [0, 1].
pub fn pack_rgba8(color: [f64; 4]) -> u32 {
    let byte = |value: f64| (value.clamp(0.0, 1.0) * 255.0).round() as u32;
    byte(color[0]) | byte(color[1]) << 8 | byte(color[2]) << 16 | byte(color[3]) << 24
}

pub fn unpack_rgba8(packed: u32) -> [f64; 4] {
    [0, 8, 16, 24].map(|shift| f64::from(packed >> shift & 0xff) / 255.0)
}
