//! From an opened scene to what the GPU moves: the grid, one voxel cache per (mesh, stretch, span,
//! mode, lattice phase), and the lattice each object's cache lies on. CPU only, cancellable.

mod exact;
mod fold;
mod framing;
mod hidden;
mod lattice;

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;

use crate::data::grid::Grid;
use crate::data::voxel_cache::{Tile, VoxelCache, VoxelizationMode};
use crate::progress::{Cancelled, Progress};
use crate::scene::bounds::Aabb;
use crate::scene::{Motion, Object, Scene};
use crate::settings::Discretization;
use crate::stages::voxelize::{self, TexturePyramids, VoxelizeError};

pub use exact::{ExactError, ExactSurface, ExactVoxel, ExactVoxels};
pub use fold::{FrameMatrices, MotionError};
pub use lattice::Lattice;

/// A scene made ready for a grid. Immutable; shared by window, engine and background work.
#[derive(Debug)]
pub struct Prepared {
    pub scene: Arc<Scene>,
    pub textures: Arc<TexturePyramids>,
    pub grid: Grid,
    pub mode: VoxelizationMode,
    pub objects: Vec<PreparedObject>,
    pub caches: Vec<Arc<VoxelCache>>,
    /// Every tile of every object, rigid ones first, then skinned: the unit of Object I-O.
    pub parts: Vec<PreparedPart>,
    /// The scene's posed bounds over all its animation; `None` where there is nothing to see.
    pub bounds: Option<Aabb>,
    pub warnings: Vec<String>,
    pub voxelize_ms: f64,
    keys: Vec<CacheKey>,
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
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrepareError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error("{scene}: object \"{object}\" cannot be voxelized: {cause}")]
    Object { scene: String, object: String, cause: VoxelizeError },
    #[error("the span is {0}; it must be a positive, finite number of scene units")]
    Span(f64),
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

/// Voxelizes every object of `scene` once. Caches of `reuse` that still fit are taken over.
pub fn prepare(
    scene: Arc<Scene>,
    discretization: &Discretization,
    reuse: Option<&Prepared>,
    progress: &Progress,
) -> Result<Prepared, PrepareError> {
    let started = Instant::now();
    let bounds = scene.bounds_over_time();
    let grid = lattice::grid_around(bounds, discretization)?;
    let reuse = reuse.filter(|old| Arc::ptr_eq(&old.scene, &scene));
    let textures =
        reuse.map_or_else(|| Arc::new(TexturePyramids::new(&scene.textures)), |old| Arc::clone(&old.textures));
    let mut warnings = scene.warnings.clone();
    warnings.extend(scene.motion_warnings(grid.span));
    let mut objects = lattice::visible_objects(&scene, &grid);
    let (keys, first_users) = number_caches(&mut objects);
    let reusable = reuse
        .filter(|old| old.grid.span == grid.span && old.grid.anchor == grid.anchor && old.mode == discretization.mode);
    let work = Work { scene: &scene, textures: &textures, mode: discretization.mode, progress };
    let old_caches: Vec<Option<Arc<VoxelCache>>> =
        keys.iter().map(|key| reusable.and_then(|old| old.cache(key))).collect();
    for (&user, _) in first_users.iter().zip(&old_caches).filter(|(_, old)| old.is_none()) {
        progress.add_total(work.input(&objects[user]).work_units());
    }
    let caches = first_users
        .par_iter()
        .zip(old_caches)
        .map(|(&user, old)| old.map_or_else(|| work.voxelize(&objects[user]).map(Arc::new), Ok))
        .collect::<Result<Vec<_>, _>>()?;
    let parts = list_parts(&objects, &caches);
    let voxelize_ms = started.elapsed().as_secs_f64() * 1e3;
    let mode = discretization.mode;
    Ok(Prepared { scene, textures, grid, mode, objects, caches, parts, bounds, warnings, voxelize_ms, keys })
}

impl Prepared {
    fn cache(&self, key: &CacheKey) -> Option<Arc<VoxelCache>> {
        let index = self.keys.iter().position(|old| old == key)?;
        Some(Arc::clone(&self.caches[index]))
    }

    /// Voxels of all objects, whether in the grid or not.
    pub fn voxel_count(&self) -> u64 {
        self.parts.iter().map(|part| part.tile.voxels.len() as u64).sum()
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

struct Work<'a> {
    scene: &'a Scene,
    textures: &'a TexturePyramids,
    mode: VoxelizationMode,
    progress: &'a Progress,
}

impl<'a> Work<'a> {
    fn input(&self, object: &PreparedObject) -> voxelize::VoxelizeInput<'a> {
        let lattice = &object.lattice;
        let parts = self.scene.meshes[object.object.mesh].primitives.iter().map(|primitive| voxelize::VoxelizePart {
            primitive,
            positions_cells: primitive.positions.iter().map(|p| lattice.cells_from_mesh(p.as_dvec3())).collect(),
            normals: lattice::normals_in_cells(lattice, &primitive.normals),
        });
        voxelize::VoxelizeInput {
            parts: parts.collect(),
            materials: &self.scene.materials,
            textures: self.textures,
            mode: self.mode,
            with_joints: matches!(object.object.motion, Motion::Skinned { .. }),
        }
    }

    fn voxelize(&self, object: &PreparedObject) -> Result<VoxelCache, PrepareError> {
        voxelize::voxelize(&self.input(object), self.progress).map_err(|cause| match cause {
            VoxelizeError::Cancelled(cancelled) => PrepareError::Cancelled(cancelled),
            cause => PrepareError::Object { scene: self.scene.name.clone(), object: object.object.name.clone(), cause },
        })
    }
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
            }));
        }
    }
    parts
}
