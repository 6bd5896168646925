//! From an opened scene to what the GPU moves: the grid, one voxel cache per (mesh, stretch, span,
//! mode, lattice phase), and the lattice each object's cache lies on. CPU only, cancellable. Voxels that
//! an earlier preparation or a disk cache holds are not made again.

mod caches;
mod clips;
mod emission;
mod enclose;
mod exact;
mod fold;
mod framing;
mod hidden;
pub mod kept;
mod lattice;
mod lights;
mod preparation;

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use self::kept::TextureHashes;
use crate::data::grid::Grid;
use crate::data::voxel_cache::{Tile, VoxelCache};
use crate::progress::{Cancelled, Progress};
use crate::scene::bounds::Aabb;
use crate::scene::{Motion, Object, Scene, Warning};
use crate::settings::{VisibilityError, VoxelizationMode};
use crate::stages::voxelize::{TexturePyramids, VoxelizeError};

pub use caches::{CacheOrigins, Stores};
use caches::{CacheSearch, CacheToFind};
pub use exact::{ExactError, ExactSurface, ExactVoxel, ExactVoxels};
pub use fold::{FrameMatrices, MotionError};
pub use lattice::Lattice;
pub use lights::LightsError;
pub use preparation::Preparation;

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
    /// The scene's posed bounds at rest and over all its clips, wherever the grid is.
    pub reach: Option<Aabb>,
    pub warnings: Vec<Warning>,
    pub voxelize_ms: f64,
    keys: Vec<CacheKey>,
    texture_hashes: Arc<TextureHashes>,
}

#[derive(Clone, Debug)]
pub struct PreparedObject {
    pub object: Object,
    /// Into [`Prepared::caches`].
    pub cache: usize,
    pub lattice: Lattice,
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

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrepareError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    #[error("{scene}: object \"{object}\" cannot be voxelized: {cause}")]
    Object { scene: String, object: String, cause: VoxelizeError },
    #[error("the span is {0}; it must be a positive, finite number of scene units")]
    Span(f64),
    #[error(
        "{scene}: at a span of {span} it is {cells:.3e} cells wide, and {limit} is the limit; choose a larger span"
    )]
    TooWide { scene: String, span: f64, cells: f64, limit: f64 },
    #[error("the grid has {0} cells along an axis; it must be 64, 128, 256, 512 or 1024")]
    Grid(u32),
}

/// What a cache's content depends on, apart from the scene, span and mode common to all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct CacheKey {
    mesh: usize,
    skinned: bool,
    on_grid: bool,
    lattice: [u64; 16],
}

/// Voxelizes every object of `scene` once. Caches of `reuse` that still fit are taken over. Nothing
/// is read from or written to the disk.
pub fn prepare(
    scene: Arc<Scene>,
    preparation: impl Into<Preparation>,
    reuse: Option<&Prepared>,
    progress: &Progress,
) -> Result<Prepared, PrepareError> {
    prepare_with(scene, preparation, Stores { reuse, disk: None }, progress)
}

/// The same, looking first for voxels in `stores`; what is voxelized is kept on the disk.
pub fn prepare_with(
    scene: Arc<Scene>,
    preparation: impl Into<Preparation>,
    stores: Stores,
    progress: &Progress,
) -> Result<Prepared, PrepareError> {
    let started = Instant::now();
    let preparation = preparation.into();
    let discretization = &preparation.discretization;
    let clip = clips::clip_index(&scene, &preparation.motion)?;
    let (bounds, left_out) = enclose::enclosed(&scene, &preparation, clip)?;
    let grid = lattice::grid_around(&scene.name, bounds, discretization)?;
    let motion = scene.motion_report(grid.span, clip);
    let mut warnings = scene.warnings.clone();
    warnings.extend(left_out);
    warnings.extend(motion.warnings());
    let (mut objects, shared) = lattice::visible_objects(&scene, &grid, motion);
    warnings.extend(shared);
    let (keys, first_users) = number_caches(&mut objects);
    let mode = discretization.mode;
    let reuse = stores.reuse.filter(|old| Arc::ptr_eq(&old.scene, &scene));
    let (textures, texture_hashes) = match reuse {
        Some(old) => (Arc::clone(&old.textures), Arc::clone(&old.texture_hashes)),
        None => (Arc::new(TexturePyramids::new(&scene.textures)), Arc::new(TextureHashes::new(&scene.textures))),
    };
    let reusable = reuse.filter(|old| old.grid.span == grid.span && old.grid.anchor == grid.anchor && old.mode == mode);
    let wanted: Vec<CacheToFind> = keys
        .iter()
        .zip(&first_users)
        .map(|(key, &user)| CacheToFind { object: &objects[user], kept: reusable.and_then(|old| old.cache(key)) })
        .collect();
    let work = CacheSearch::new(&scene, &textures, &texture_hashes, mode, stores.disk, progress);
    let (caches, origins) = work.run(wanted)?;
    warnings.extend(work.into_warning());
    let parts = list_parts(&objects, &caches);
    let (brightest_emission, warning) = emission::brightest(&scene.name, &caches);
    warnings.extend(warning);
    let reach = scene.bounds_over_time();
    let voxelize_ms = started.elapsed().as_secs_f64() * 1e3;
    Ok(Prepared {
        scene,
        reach,
        preparation,
        textures,
        grid,
        mode,
        objects,
        caches,
        origins,
        parts,
        brightest_emission,
        bounds,
        warnings,
        voxelize_ms,
        keys,
        texture_hashes,
    })
}

impl Prepared {
    fn cache(&self, key: &CacheKey) -> Option<Arc<VoxelCache>> {
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

/// Gives equal geometry on equal lattices one cache; returns their keys and a first object of each.
fn number_caches(objects: &mut [PreparedObject]) -> (Vec<CacheKey>, Vec<usize>) {
    let mut numbers: HashMap<CacheKey, usize> = HashMap::new();
    let mut keys = Vec::new();
    let mut first_users = Vec::new();
    for (index, object) in objects.iter_mut().enumerate() {
        let key = CacheKey {
            mesh: object.object.mesh,
            skinned: matches!(object.object.motion, Motion::Skinned { .. }),
            on_grid: object.lattice.is_grid(),
            lattice: object.lattice.bits(),
        };
        object.cache = *numbers.entry(key).or_insert_with(|| {
            keys.push(key);
            first_users.push(index);
            keys.len() - 1
        });
    }
    (keys, first_users)
}

/// Rigid parts first, so that one work list serves both kernels.
fn list_parts(objects: &[PreparedObject], caches: &[Arc<VoxelCache>]) -> Vec<PreparedPart> {
    let mut parts: Vec<PreparedPart> = Vec::new();
    for skinned in [false, true] {
        for (index, object) in objects.iter().enumerate() {
            if matches!(object.object.motion, Motion::Skinned { .. }) != skinned {
                continue;
            }
            let cache = &caches[object.cache];
            parts.extend(cache.tiles.iter().map(|tile| PreparedPart {
                object: index,
                tile: tile.clone(),
                extent_cells: lattice::tile_extent(cache, tile),
                joints: if skinned { fold::used_joints(cache, tile) } else { Vec::new() },
            }));
        }
    }
    parts
}
