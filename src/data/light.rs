//! Light in the octree, apart from its occupancy: what leaves each node, and what arrives at each leaf.
//!
//! ```text
//! light       4 floats an entry, radiance (nits) times opacity, and opacity, 0 … 1
//!             inner nodes by index │ occupied leaves by slot │ opacity of inner nodes along x, y, z
//!                                                              (where it is kept by direction)
//! shown       the same of irradiance (lux), for the view of it
//! direct      3 floats an occupied leaf: irradiance from lights and sky, lux
//! gathered    the same from other leaves, by the last bounce
//! leaf_emission    3 floats an occupied leaf, 1 = the brightest emission of the scene
//! sorted_emission  2 words a sorted voxel, 20 bits a channel: 0 … EMISSION_MAX, the same unit
//! emitting_blocks  1 word a leaf block: any of its voxels emits
//! ```
//!
//! Radiance times opacity is what interpolates and averages; over opacity it is the mean radiance.

use super::octree::{OctreeParams, Slot};
use crate::gpu::{Constant, constants};

/// Largest stored emission of a voxel: 20 bits, so that 2^20 of them times 2^24 fit in two words.
pub const EMISSION_MAX: u32 = (1 << 20) - 1;

pub const CONSTANTS: &[Constant] = constants![
    integer EMISSION_MAX,
];

/// Bytes of an entry of `light`.
pub const LIGHT_BYTES: u64 = 16;
/// Bytes of three floats.
pub const IRRADIANCE_BYTES: u64 = 12;

/// What leaves of one octree emit, and what it is made from.
#[derive(Debug, Default)]
pub struct EmissionBuffers {
    pub leaf_emission: Slot,
    pub sorted_emission: Slot,
    pub emitting_blocks: Slot,
}

/// Bytes of `light` for an octree. `is_directional`: opacity is kept along each axis too.
pub fn light_bytes(octree: &OctreeParams, is_directional: bool) -> u64 {
    let inner = u64::from(octree.inner_node_count);
    let by_direction = if is_directional { inner } else { 0 };
    LIGHT_BYTES * (inner + u64::from(octree.leaf_count) + by_direction)
}

/// Emission of a voxel in units of the scene's brightest over [`EMISSION_MAX`].
pub fn pack_emission(emission: [f32; 3], brightest: f32) -> [u32; 2] {
    let unit = |channel: f32| (f64::from(channel) / f64::from(brightest) * f64::from(EMISSION_MAX)).round() as u32;
    let [r, g, b] = emission.map(unit);
    [r | g << 20, g >> 12 | b << 8]
}
