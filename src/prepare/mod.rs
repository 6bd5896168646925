//! From an opened scene to what the GPU moves: the grid, one voxel cache per (mesh, stretch, span,
//! mode, lattice phase), and the lattice each object's cache lies on. CPU only, cancellable. Voxels that
//! an earlier preparation or a disk cache holds are not made again.

mod caches;
mod clips;
mod emission;
mod enclose;
mod error;
mod exact;
mod fold;
mod framing;
mod hidden;
pub mod kept;
mod lattice;
mod lights;
mod origins;
mod placing;
mod preparation;
mod prepared;
mod room;

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use self::kept::TextureHashes;
use crate::data::voxel_cache::VoxelCache;
use crate::progress::Progress;
use crate::scene::{Motion, Scene};
use crate::stages::voxelize::TexturePyramids;

pub use caches::Stores;
use caches::{CacheSearch, CacheToFind};
use enclose::Enclosed;
pub use error::PrepareError;
pub use exact::{ExactError, ExactSurface, ExactVoxel, ExactVoxels};
pub use fold::{FrameMatrices, MotionError};
pub use hidden::LeftToEach;
pub use lattice::Lattice;
pub use lights::LightsError;
pub use origins::CacheOrigins;
use placing::{grid_around, tile_extent, visible_objects};
pub use preparation::Preparation;
use prepared::CacheKey;
pub use prepared::{Prepared, PreparedObject, PreparedPart};
pub use room::Room;

/// Voxelizes every object of `scene` once. Caches of `reuse` that still fit are taken over. Nothing
/// is read from or written to the disk.
pub fn prepare(
    scene: Arc<Scene>,
    preparation: impl Into<Preparation>,
    reuse: Option<&Prepared>,
    progress: &Progress,
) -> Result<Prepared, PrepareError> {
    prepare_with(scene, preparation, Stores { reuse, ..Stores::default() }, progress)
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
    let reuse = stores.reuse.filter(|old| Arc::ptr_eq(&old.scene, &scene));
    let reach = reuse.map_or_else(|| scene.bounds_over_time(), |old| old.reach);
    let earlier = reuse.filter(|old| old.preparation.same_but_for_its_moment(&preparation));
    let Enclosed { bounds, at_first, warnings: left_out } =
        enclose::enclosed(&scene, &preparation, clip, reach, earlier)?;
    let grid = grid_around(&scene.name, bounds, discretization)?;
    let motion = scene.motion_report(grid.span, clip);
    let mut warnings = scene.warnings.clone();
    warnings.extend(left_out);
    warnings.extend(motion.warnings());
    let (mut objects, shared) = visible_objects(&scene, &grid, motion);
    warnings.extend(shared);
    let (keys, first_users) = number_caches(&mut objects);
    if let Some(room) = stores.room {
        let pose = || scene.pose(clip, preparation.motion.time_secs);
        room.check((&scene, &pose), (&grid, discretization), (&objects, &first_users))?;
    }
    let (mode, weights) = (discretization.mode, discretization.weights);
    let (textures, texture_hashes) = match reuse {
        Some(old) => (Arc::clone(&old.textures), Arc::clone(&old.texture_hashes)),
        None => (Arc::new(TexturePyramids::new(&scene.textures)), Arc::new(TextureHashes::new(&scene.textures))),
    };
    let is_alike = |old: &&Prepared| {
        let made = &old.preparation.discretization;
        old.grid.span == grid.span && old.grid.anchor == grid.anchor && (made.mode, made.weights) == (mode, weights)
    };
    let reusable = reuse.filter(is_alike);
    let wanted: Vec<CacheToFind> = keys
        .iter()
        .zip(&first_users)
        .map(|(key, &user)| CacheToFind { object: &objects[user], kept: reusable.and_then(|old| old.cache(key)) })
        .collect();
    let work = CacheSearch::new(&scene, &textures, &texture_hashes, (mode, weights), stores.disk, progress);
    let (caches, origins) = work.run(wanted)?;
    warnings.extend(work.into_warning());
    let parts = list_parts(&objects, &caches);
    let (brightest_emission, warning) = emission::brightest(&scene, &caches);
    warnings.extend(warning);
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
        at_first: at_first.or(bounds),
        warnings,
        voxelize_ms,
        keys,
        texture_hashes,
    })
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
                extent_cells: tile_extent(cache, tile),
                joints: if skinned { fold::used_joints(cache, tile) } else { Vec::new() },
            }));
        }
    }
    parts
}
