//! What the picture shows, and how.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::view::{SurfaceView, View};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Look {
    pub view: View,
    pub color: ColorBy,
    /// Octree level shown; `None`: the leaves.
    pub level: Option<u32>,
    pub alpha: AlphaRule,
    pub voxel_edges: bool,
    /// A headlight from the camera; off shows the bare colour.
    pub shaded: bool,
    /// Also measures the filter not shown, and both against the exact posed voxelization.
    pub accuracy: bool,
    /// Light is multiplied by 2 to this before it is shown; `None`: what the scene's mean radiance asks for.
    pub exposure_stops: Option<f64>,
    pub tone_curve: ToneCurve,
    pub slice: Slice,
    pub surface: SurfaceView,
    /// Which light's shadow map the shadow map view shows, from 0.
    pub shadow_map: usize,
    /// The octree keeps the neighbour pointers that the window draws and follows.
    pub pointers: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            view: View::default(),
            color: ColorBy::default(),
            level: None,
            alpha: AlphaRule::default(),
            voxel_edges: false,
            shaded: true,
            accuracy: false,
            exposure_stops: None,
            tone_curve: ToneCurve::default(),
            slice: Slice::default(),
            surface: SurfaceView::default(),
            shadow_map: 0,
            pointers: false,
        }
    }
}

impl Look {
    pub const EXPOSURE_STOPS: RangeInclusive<f64> = -40.0..=40.0;

    /// For an octree of `depth` levels below its root.
    pub(super) fn check(&self, depth: u32) -> Result<(), String> {
        if let Some(level) = self.level.filter(|level| *level > depth) {
            return Err(format!("level {level} is not one of 0 (the root) to {depth} (the leaves)"));
        }
        if let Some(stops) = self.exposure_stops.filter(|stops| !Self::EXPOSURE_STOPS.contains(stops)) {
            return Err(format!("an exposure of {stops} stops is not in -40 to 40"));
        }
        if !(0.0..=1.0).contains(&self.slice.height) {
            return Err(format!("a slice at {} of the grid is not in 0 to 1", self.slice.height));
        }
        if !Slice::WIDTHS_CELLS.contains(&self.slice.width_cells) {
            return Err(format!("a width of {} cells is not in 1 to 1024", self.slice.width_cells));
        }
        Ok(())
    }

    /// Whether the picture shows light that the octree holds.
    /// Shown with an exposure.
    pub fn is_exposed(&self) -> bool {
        match self.view {
            View::Voxels => self.color.is_light(),
            View::Surfaces => self.surface.is_light(),
            View::Mesh | View::Ghost | View::Slice | View::ShadowMap => false,
        }
    }

    pub fn shows_light(&self) -> bool {
        match self.view {
            View::Voxels => self.color.is_light(),
            View::Slice => self.slice.value != SliceValue::Occupancy,
            View::Surfaces => self.surface.is_light(),
            View::ShadowMap => true,
            View::Mesh | View::Ghost => false,
        }
    }
}

/// A plane through the grid on which the octree is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Slice {
    /// The plane lies across this axis.
    pub axis: SliceAxis,
    /// Where along the axis, 0 to 1 of the grid.
    pub height: f64,
    pub value: SliceValue,
    pub sampling: Sampling,
    pub lookup: Lookup,
    /// Width of the samples, leaf cells: which levels are read.
    pub width_cells: f64,
    /// Colours go with the logarithm of the value.
    pub logarithmic: bool,
}

impl Slice {
    pub const WIDTHS_CELLS: RangeInclusive<f64> = 1.0..=1024.0;
}

impl Default for Slice {
    fn default() -> Self {
        Self {
            axis: SliceAxis::default(),
            height: 0.5,
            value: SliceValue::default(),
            sampling: Sampling::default(),
            lookup: Lookup::default(),
            width_cells: 1.0,
            logarithmic: true,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SliceAxis {
    X,
    #[default]
    Y,
    Z,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SliceValue {
    /// Luminance of the mean radiance, nits.
    #[default]
    Radiance,
    /// Luminance of the mean irradiance, lux.
    Irradiance,
    /// Occupied share, 0 to 1.
    Occupancy,
}

impl SliceValue {
    /// The colours of its scale.
    pub fn color(self) -> ColorBy {
        match self {
            Self::Radiance => ColorBy::Radiance,
            Self::Irradiance => ColorBy::Irradiance,
            Self::Occupancy => ColorBy::Occupancy,
        }
    }
}

/// How a place between nodes gets its value (section 4.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sampling {
    /// The node it lies in.
    Nearest,
    /// The eight nodes around it, of one level.
    Trilinear,
    /// Trilinear on two neighbouring levels, blended by log2 of the width.
    #[default]
    Quadrilinear,
}

/// How the eight nodes around a place are found; the values are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lookup {
    /// Each by the rank of its bit in the block masks.
    #[default]
    Ranks,
    /// One by descent, the others by forward pointers stored once a block.
    BlockPointers,
    /// The same by pointers stored with every node, as in the paper.
    NodePointers,
}

/// How exposed light becomes the 0 to 1 of a screen, channel by channel, before gamma encoding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneCurve {
    /// As it is, cut at 1.
    Linear,
    /// x / (1 + x) (Reinhard 2002).
    Reinhard,
    /// Narkowicz's fit of the ACES film curve.
    #[default]
    Aces,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorBy {
    #[default]
    Albedo,
    Normal,
    Occupancy,
    Object,
    Level,
    /// What leaves the voxels, emission included.
    Radiance,
    /// What arrives at them.
    Irradiance,
}

impl ColorBy {
    pub fn is_light(self) -> bool {
        matches!(self, Self::Radiance | Self::Irradiance)
    }
}

/// How much of the light a visited voxel of occupancy α stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AlphaRule {
    /// α once a visited voxel, as in the paper's Fig. 8.
    #[default]
    Paper,
    /// 1 − (1 − α)^(s/δ) for a path of length s inside it.
    Length,
}
