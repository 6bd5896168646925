//! A scene that is prepared.

use std::sync::Arc;

use super::kept::TextureHashes;
use super::lattice::Lattice;
use super::origins::CacheOrigins;
use super::preparation::Preparation;
use crate::data::grid::Grid;
use crate::data::voxel_cache::{Tile, VoxelCache};
use crate::scene::bounds::Aabb;
use crate::scene::{Motion, Object, Scene, Unmovable, Warning};
use crate::settings::VoxelizationMode;
use crate::stages::voxelize::TexturePyramids;

/// A scene made ready for a grid. Immutable; shared by window, engine and background work.
#[derive(Debug)]
pub struct Prepared {
    pub scene: Arc<Scene>,
    pub textures: Arc<TexturePyramids>,
    pub grid: Grid,
    pub mode: VoxelizationMode,
    pub objects: Vec<PreparedObject>,
    pub caches: Vec<Arc<VoxelCache>>,
    /// Where the caches came from.
    pub origins: CacheOrigins,
    /// Every tile of every object, rigid ones first, then skinned: the unit of Object I-O.
    pub parts: Vec<PreparedPart>,
    /// Largest channel of any voxel's emission, nits; 0 where nothing emits.
    pub brightest_emission: f32,
    /// What it was made for.
    pub preparation: Preparation,
    /// What the grid encloses or is centred on; `None` where there is nothing to see.
    pub bounds: Option<Aabb>,
    /// What of it is there when the clip begins, or all of it where that is nothing.
    pub at_first: Option<Aabb>,
    /// The scene's posed bounds at rest and over all its clips, wherever the grid is.
    pub reach: Option<Aabb>,
    pub warnings: Vec<Warning>,
    pub voxelize_ms: f64,
    pub(super) keys: Vec<CacheKey>,
    pub(super) texture_hashes: Arc<TextureHashes>,
}

#[derive(Clone, Debug)]
pub struct PreparedObject {
    pub object: Object,
    /// Into [`Prepared::caches`].
    pub cache: usize,
    pub lattice: Lattice,
    /// Where it is no rigid motion of its voxels.
    pub unmovable: Option<Unmovable>,
}

impl PreparedObject {
    /// Its triangles may be where no box around its voxels is.
    pub fn may_leave_its_voxels(&self) -> bool {
        matches!(self.unmovable, Some(Unmovable::Morphs { .. }))
    }
}

/// One tile of an object's cache.
#[derive(Clone, Debug)]
pub struct PreparedPart {
    /// Into [`Prepared::objects`].
    pub object: usize,
    pub tile: Tile,
    /// Largest position in the tile, plus one, per axis: with `tile.origin` its box in cells.
    pub extent_cells: glam::IVec3,
    /// Joints that move any of its voxels; none where it is rigid.
    pub joints: Vec<usize>,
}

/// What a cache's content depends on, apart from the scene, span and mode common to all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct CacheKey {
    pub mesh: usize,
    pub skinned: bool,
    pub on_grid: bool,
    pub lattice: [u64; 16],
}

impl Prepared {
    pub(super) fn cache(&self, key: &CacheKey) -> Option<Arc<VoxelCache>> {
        let index = self.keys.iter().position(|old| old == key)?;
        Some(Arc::clone(&self.caches[index]))
    }

    /// What the scene's textures hold.
    pub fn texture_hashes(&self) -> &TextureHashes {
        &self.texture_hashes
    }

    /// Voxels of all objects, whether in the grid or not.
    pub fn voxel_count(&self) -> u64 {
        self.parts.iter().map(|part| part.tile.voxels.len() as u64).sum()
    }

    /// Rigid parts come first, with one matrix each.
    pub fn rigid_parts(&self) -> usize {
        self.parts.iter().take_while(|part| !self.is_skinned(part)).count()
    }

    pub fn is_skinned(&self, part: &PreparedPart) -> bool {
        matches!(self.objects[part.object].object.motion, Motion::Skinned { .. })
    }
}
