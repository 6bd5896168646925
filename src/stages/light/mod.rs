//! Lights the octree (sections 4.3 and 4.4): each light's irradiance on every occupied leaf, what leaves
//! the leaf, and its average up to the root. Sky and bounces gather by cones.
//!
//! ```text
//! lights ─► shadow (a map a light) ─► illuminate (direct irradiance) ─► inject ─► average_light
//!                                      gather (sky, bounces) ─────────────▲  │
//!                                        ▲───────────────────────────────────┘
//! ```

pub mod average_light;
pub mod average_light_ref;
pub mod gather;
pub mod gather_ref;
pub mod illuminate;
pub mod illuminate_ref;
pub mod inject;
pub mod inject_ref;
pub mod shadow;

use crate::data::octree::{OctreeRef, OctreeSizes};
use crate::gpu::{Constant, GpuBuffer, GpuError, Kernel, PassBuilder, constants};
use crate::stages::fill::ranked::RankedLeaves;

pub const LIGHT_DIRECTIONAL: u32 = 0;
pub const LIGHT_POINT: u32 = 1;
pub const LIGHT_SPOT: u32 = 2;

pub const SHADOWS_OFF: u32 = 0;
pub const SHADOWS_MAP: u32 = 1;
pub const SHADOWS_MARCH: u32 = 2;

/// A leaf is a cell wide: no light is nearer to it than half of that.
pub const LEAST_DISTANCE_CELLS: f64 = 0.5;
/// Mean of max(cosine, 0) over all directions.
pub const SPREAD_COSINE: f64 = 0.25;

pub const CONSTANTS: &[Constant] = constants![
    integer LIGHT_DIRECTIONAL,
    integer LIGHT_SPOT,
    integer SHADOWS_MAP,
    integer SHADOWS_OFF,
    float LEAST_DISTANCE_CELLS,
    float SPREAD_COSINE,
];

/// What lighting reads of a built octree.
#[derive(Clone, Debug)]
pub struct LitOctree {
    pub sizes: OctreeSizes,
    pub ranked: RankedLeaves,
    pub occupied: GpuBuffer,
    pub block_keys: GpuBuffer,
    pub first_child: GpuBuffer,
    pub leaves: GpuBuffer,
    pub nodes: GpuBuffer,
}

impl LitOctree {
    /// Fails until all of it was built.
    pub fn new(octree: OctreeRef<'_>) -> Result<Self, GpuError> {
        let OctreeRef { sizes, masks, topology, payload } = octree;
        Ok(Self {
            sizes: sizes.clone(),
            ranked: RankedLeaves::new(octree)?,
            occupied: masks.occupied.made("occupied masks")?,
            block_keys: topology.block_keys.made("block keys")?,
            first_child: topology.first_child.made("child pointers")?,
            leaves: payload.leaves.made("leaves")?,
            nodes: payload.nodes.made("nodes")?,
        })
    }

    /// By the names in shaders/shared/light_through.wgsl.
    pub(super) fn bind_leaves<'r>(&self, pass: PassBuilder<'r, Kernel>) -> PassBuilder<'r, Kernel> {
        self.ranked.bind(pass, &self.sizes).bind("occupied", &self.occupied).bind("leaves", &self.leaves)
    }
}
