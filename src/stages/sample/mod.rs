//! Asks the lit octree for radiance and opacity anywhere (section 4.4): nearest node, trilinear in a
//! level, or quadrilinear at a width, the nodes found by rank look-up or by pointers as in the paper.
//!
//! In: an octree and its `light` (data::light). Out: (radiance · α, α), α being opacity per leaf cell of length. All look-ups give the same bits.

pub mod sample_points;
pub mod sample_points_ref;

use crate::data::octree::{OctreeRef, OctreeSizes, PointerLayout};
use crate::gpu::{Constant, GpuBuffer, GpuError, Kernel, PassBuilder, constants};
use crate::settings::lighting::Opacity;
use crate::settings::{Lookup, Sampling};
use crate::stages::fill::ranked::RankedLeaves;

pub const FILTER_NEAREST: u32 = 0;
pub const FILTER_TRILINEAR: u32 = 1;
pub const FILTER_QUADRILINEAR: u32 = 2;

/// Along an axis a node lets through no less than this, the last place of an f32 opacity.
pub const LEAST_THROUGH: f64 = 1.0 / (1 << 24) as f64;

/// Nodes count for the cones of a surface where they lie as far above its plane: the split filter spreads a
/// voxel into the cells around it.
pub const HORIZON_CELLS: f64 = 1.0;
/// Above that, nodes count in full from this part of their width on, so that nothing jumps as surfaces move.
pub const HORIZON_FADE: f64 = 0.5;
/// The least share of a sample's weight that stands for all of it.
pub const HORIZON_SHARE: f64 = 0.25;

pub const CONSTANTS: &[Constant] = constants![
    integer FILTER_QUADRILINEAR,
    integer FILTER_TRILINEAR,
    float HORIZON_CELLS,
    float HORIZON_FADE,
    float HORIZON_SHARE,
    float LEAST_THROUGH,
];

/// The pointers that a look-up follows, which the octree must then hold.
pub fn pointer_layout(lookup: Lookup) -> Option<PointerLayout> {
    match lookup {
        Lookup::Ranks => None,
        Lookup::BlockPointers => Some(PointerLayout::Blocks),
        Lookup::NodePointers => Some(PointerLayout::Nodes),
    }
}

/// Which sampler is compiled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sampler {
    pub sampling: Sampling,
    pub lookup: Lookup,
    /// `light` must hold it.
    pub opacity: Opacity,
}

impl Sampler {
    /// Overrides of shaders/shared/sample.wgsl.
    pub fn value_constants(&self) -> [(&'static str, f64); 2] {
        let filter = match self.sampling {
            Sampling::Nearest => FILTER_NEAREST,
            Sampling::Trilinear => FILTER_TRILINEAR,
            Sampling::Quadrilinear => FILTER_QUADRILINEAR,
        };
        [("FILTER", filter.into()), ("DIRECTIONAL", flag(self.opacity.is_directional()))]
    }

    /// Overrides of shaders/shared/look_up.wgsl, which imports the other.
    pub fn constants(&self) -> [(&'static str, f64); 4] {
        let [filter, directional] = self.value_constants();
        [
            filter,
            ("LINKED", flag(self.lookup != Lookup::Ranks)),
            ("NODE_POINTERS", flag(self.lookup == Lookup::NodePointers)),
            directional,
        ]
    }
}

fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}

/// What a sampler with any look-up reads.
#[derive(Clone, Debug)]
pub struct SampledOctree {
    pub sizes: OctreeSizes,
    pub ranked: RankedLeaves,
    pub first_child: GpuBuffer,
    /// Under rank look-up any buffer: nothing of it is read.
    pub neighbours: GpuBuffer,
    pub light: GpuBuffer,
}

impl SampledOctree {
    /// `pointers`: those of the look-up, which others do not read. The error names what was not made: the octree,
    /// or the pointers.
    pub fn new(
        octree: OctreeRef<'_>,
        light: &GpuBuffer,
        lookup: Lookup,
        pointers: Option<&GpuBuffer>,
    ) -> Result<Self, GpuError> {
        let OctreeRef { sizes, topology, .. } = octree;
        let ranked = RankedLeaves::new(octree)?;
        let made = |label: &str| pointers.cloned().ok_or_else(|| GpuError::Missing { label: label.to_owned() });
        let neighbours = match pointer_layout(lookup) {
            None => ranked.ranks.clone(),
            Some(PointerLayout::Blocks) => made("neighbour pointers")?,
            Some(PointerLayout::Nodes) => made("neighbour pointers of nodes")?,
        };
        Ok(Self {
            sizes: sizes.clone(),
            ranked,
            first_child: topology.first_child.made("child pointers")?,
            neighbours,
            light: light.clone(),
        })
    }

    /// Without pointers, by the names in shaders/shared/corners_ranked.wgsl.
    pub(super) fn bind_ranked<'a>(&self, pass: PassBuilder<'a, Kernel>) -> PassBuilder<'a, Kernel> {
        self.ranked.bind(pass, &self.sizes).bind("light", &self.light)
    }

    /// Binds all of it by the names in shaders/shared/look_up.wgsl.
    pub fn bind<'a>(&self, pass: PassBuilder<'a, Kernel>) -> PassBuilder<'a, Kernel> {
        self.bind_ranked(pass).bind("first_child", &self.first_child).bind("neighbours", &self.neighbours)
    }
}
