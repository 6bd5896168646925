//! What the voxels are made of, and how they move.

use serde::{Deserialize, Serialize};

/// What the voxels are made of. A change of grid, span or mode voxelizes again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Discretization {
    /// N, cells along an axis: a power of two, 64 to 1024.
    pub grid: u32,
    /// δ in scene units; `None`: as large as what the grid encloses asks for ([`super::Fit`]).
    pub span: Option<f64>,
    pub mode: VoxelizationMode,
    /// Of voxels that joints move. A change voxelizes again.
    pub weights: JointWeights,
    pub filter: Filter,
    /// Levels 0 to this one are stored densely, and never the leaves; `None`: [`Self::USUAL_DENSE_LEVEL`], or one
    /// above the leaves where the grid has no more.
    pub dense_level: Option<u32>,
    pub anchor: VoxelAnchor,
    pub discretizer: Discretizer,
    /// Of what moving would tear or fold.
    pub stretching: Stretching,
    /// Of the voxelizer.
    pub cells: VoxelizerCells,
}

impl Default for Discretization {
    fn default() -> Self {
        Self {
            grid: 128,
            span: None,
            mode: VoxelizationMode::default(),
            weights: JointWeights::default(),
            filter: Filter::default(),
            dense_level: None,
            anchor: VoxelAnchor::default(),
            discretizer: Discretizer::default(),
            stretching: Stretching::default(),
            cells: VoxelizerCells::default(),
        }
    }
}

impl Discretization {
    pub const GRIDS: [u32; 5] = [64, 128, 256, 512, 1024];
    pub const USUAL_DENSE_LEVEL: u32 = 6;
    pub const MAX_DENSE_LEVEL: u32 = 9;

    /// log2 of the grid.
    pub fn depth(&self) -> u32 {
        self.grid.ilog2()
    }

    /// The last level that is stored densely, one above the leaves at most.
    pub fn deepest_dense(&self) -> u32 {
        self.dense_level.unwrap_or(Self::USUAL_DENSE_LEVEL).min(self.depth() - 1)
    }

    /// Are all values in range? If not, the sentence names value and range.
    pub fn check(&self) -> Result<(), String> {
        if !Self::GRIDS.contains(&self.grid) {
            return Err(format!("a grid of {} cells is not one of {:?}", self.grid, Self::GRIDS));
        }
        if let Some(level) = self.dense_level.filter(|level| *level > Self::MAX_DENSE_LEVEL) {
            return Err(format!("dense level {level} is not in 0 to {}", Self::MAX_DENSE_LEVEL));
        }
        match self.span {
            Some(span) if !(span.is_finite() && span > 0.0) => {
                Err(format!("a span of {span} scene units is not a finite number above 0"))
            }
            _ => Ok(()),
        }
    }
}

/// Where the voxels of a frame come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Discretizer {
    /// Every object is voxelized once, and its voxels are moved (section 3.2).
    #[default]
    Transform,
    /// The posed triangles are voxelized every frame: what the paper compares with.
    Voxelize,
}

/// What is done with objects that are no rigid motion of their voxels: those that stretch by half a cell or more over
/// the clip that is played ([`crate::scene::MotionReport::stretching`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stretching {
    /// Their voxels are moved as those of other objects.
    Move,
    /// Their posed triangles are voxelized every frame; other objects are moved.
    #[default]
    Voxelize,
}

/// How the voxelizer finds the fragments of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VoxelizerCells {
    /// By a hash of the cell: memory and clearing follow what is covered.
    #[default]
    Sparse,
    /// A word for every cell of the grid, cleared every frame, as in the paper.
    Dense,
}

/// How a moved voxel falls into cells (section 3.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The one cell its centre lies in (Fig. 1a).
    Nearest,
    /// 8-neighbour split by overlap (Fig. 1b).
    #[default]
    Split,
}

impl Filter {
    /// The one it is compared with.
    pub fn other(self) -> Self {
        match self {
            Self::Nearest => Self::Split,
            Self::Split => Self::Nearest,
        }
    }

    /// As the kernels' SPLIT override.
    pub fn is_split(self) -> f64 {
        f64::from(u8::from(self == Self::Split))
    }
}

/// Which weights of a skin's joints a voxel gets from the triangles in its cell (section 3.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum JointWeights {
    /// Those of the corners, interpolated to where the triangle is in the cell.
    #[default]
    Interpolated,
    /// Those of the nearest corner.
    Flat,
}

/// Which point of a cache voxel the transformation moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VoxelAnchor {
    #[default]
    Centre,
    /// Eq. 1 to the letter: a rotated voxel lands up to √3 cells off.
    Corner,
}

/// Which cells a triangle occupies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VoxelizationMode {
    /// 6-separating: the thinnest layer no axial step passes through.
    #[default]
    Thin,
    /// Every cell a triangle touches.
    Conservative,
}

impl VoxelizationMode {
    /// As the kernels' CONSERVATIVE override.
    pub fn is_conservative(self) -> f64 {
        f64::from(u8::from(self == Self::Conservative))
    }
}
