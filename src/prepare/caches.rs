//! Finds or makes the voxel caches of a scene: from the preparation before, from the disk, or by
//! voxelizing (section 3.1). In parallel, cancellable; an object is looked for only once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::kept::{Kept, TextureHashes};
use super::{CacheOrigins, PrepareError, Prepared, PreparedObject, Room, lattice};
use crate::data::voxel_cache::VoxelCache;
use crate::disk_cache::{ContentKey, DiskCache};
use crate::progress::Progress;
use crate::scene::{Material, Mesh, Motion, Scene, Warning};
use crate::settings::{JointWeights, VoxelizationMode};
use crate::stages::voxelize::{self, TexturePyramids, VoxelizeError, VoxelizeInput, VoxelizePart};

/// Where voxels are looked for before an object is voxelized, in this order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stores<'a> {
    /// Of the same scene; of any other nothing is taken.
    pub reuse: Option<&'a Prepared>,
    pub disk: Option<&'a DiskCache>,
    /// What the voxels must fit, if anything.
    pub room: Option<&'a Room>,
}

/// A cache to find or make.
pub(super) struct CacheToFind<'a> {
    /// One that uses it.
    pub object: &'a PreparedObject,
    pub kept: Option<Arc<VoxelCache>>,
}

#[derive(Clone, Copy)]
enum Origin {
    Voxelized { replaces: bool },
    Kept,
    Read,
}

pub(super) struct CacheSearch<'a> {
    scene: &'a Scene,
    textures: &'a TexturePyramids,
    texture_hashes: &'a TextureHashes,
    mode: VoxelizationMode,
    weights: JointWeights,
    disk: Option<&'a DiskCache>,
    progress: &'a Progress,
    stored: AtomicBool,
    /// Why the disk cache does not take entries; from then on none is offered.
    refused: OnceLock<String>,
}

impl<'a> CacheSearch<'a> {
    pub fn new(
        scene: &'a Scene,
        textures: &'a TexturePyramids,
        texture_hashes: &'a TextureHashes,
        (mode, weights): (VoxelizationMode, JointWeights),
        disk: Option<&'a DiskCache>,
        progress: &'a Progress,
    ) -> Self {
        Self {
            scene,
            textures,
            texture_hashes,
            mode,
            weights,
            disk,
            progress,
            stored: AtomicBool::new(false),
            refused: OnceLock::new(),
        }
    }

    /// The wanted caches, in order.
    pub fn run(&self, wanted: Vec<CacheToFind>) -> Result<(Vec<Arc<VoxelCache>>, CacheOrigins), PrepareError> {
        let missing: Vec<&PreparedObject> =
            wanted.iter().filter(|wanted| wanted.kept.is_none()).map(|wanted| wanted.object).collect();
        for object in &missing {
            self.progress.add_total(voxelize::work_units(self.mesh(object).triangle_count() as u64));
        }
        if self.disk.is_some() {
            self.texture_hashes.make(missing.iter().flat_map(|object| self.materials(object)), self.progress)?;
        }
        let found: Result<Vec<_>, _> = wanted.into_par_iter().map(|wanted| self.find(wanted)).collect();
        // After a cancelled run too: what it has stored counts.
        if self.stored.load(Ordering::Relaxed) {
            self.trim();
        }
        let (caches, origins): (Vec<_>, Vec<_>) = found?.into_iter().unzip();
        Ok((caches, CacheOrigins::of(&origins)))
    }

    /// A warning, if the disk cache did not take what it should keep.
    pub fn into_warning(self) -> Option<Warning> {
        let (cause, disk) = (self.refused.into_inner()?, self.disk?);
        let folder = disk.folder().display();
        let sentence = format!("voxels are not kept for the next opening: {folder} cannot be written ({cause})");
        Some(Warning::new(sentence))
    }

    fn find(&self, CacheToFind { object, kept }: CacheToFind) -> Result<(Arc<VoxelCache>, Origin), PrepareError> {
        if let Some(cache) = kept {
            return Ok((cache, Origin::Kept));
        }
        let input = self.input(object);
        let voxelize = |input: &VoxelizeInput| {
            voxelize::voxelize(input, self.progress).map_err(|cause| self.named(object, cause)).map(Arc::new)
        };
        let Some(disk) = self.disk else { return Ok((voxelize(&input)?, Origin::Voxelized { replaces: false })) };
        input.check().map_err(|cause| self.named(object, cause))?;
        let key = ContentKey::of(&input, self.texture_hashes);
        let replaces = match disk.load(&key, &input) {
            Kept::Found(cache) => {
                self.progress.advance(input.work_units())?;
                return Ok((Arc::new(cache), Origin::Read));
            }
            Kept::Missing => false,
            Kept::Damaged => true,
        };
        let cache = voxelize(&input)?;
        self.keep(disk, &key, &cache);
        Ok((cache, Origin::Voxelized { replaces }))
    }

    fn keep(&self, disk: &DiskCache, key: &ContentKey, cache: &VoxelCache) {
        if self.refused.get().is_some() {
            return;
        }
        match disk.store(key, cache) {
            Ok(()) => self.stored.store(true, Ordering::Relaxed),
            Err(error) => _ = self.refused.get_or_init(|| error.to_string()),
        }
    }

    fn trim(&self) {
        if let Some(Err(error)) = self.disk.map(DiskCache::trim) {
            self.refused.get_or_init(|| error.to_string());
        }
    }

    fn named(&self, object: &PreparedObject, cause: VoxelizeError) -> PrepareError {
        match cause {
            VoxelizeError::Cancelled(cancelled) => PrepareError::Cancelled(cancelled),
            cause => PrepareError::Object { scene: self.scene.name.clone(), object: object.object.name.clone(), cause },
        }
    }

    fn mesh(&self, object: &PreparedObject) -> &'a Mesh {
        &self.scene.meshes[object.object.mesh]
    }

    fn materials(&self, object: &PreparedObject) -> impl Iterator<Item = &'a Material> {
        let materials = &self.scene.materials;
        self.mesh(object).primitives.iter().filter_map(|primitive| materials.get(primitive.material?))
    }

    fn input(&self, object: &PreparedObject) -> VoxelizeInput<'a> {
        let lattice = &object.lattice;
        let parts = self.mesh(object).primitives.iter().map(|primitive| VoxelizePart {
            primitive,
            positions_cells: primitive.positions.iter().map(|p| lattice.cells_from_mesh(p.as_dvec3())).collect(),
            normals: lattice::normals_in_cells(lattice, &primitive.normals),
        });
        VoxelizeInput {
            parts: parts.collect(),
            materials: &self.scene.materials,
            textures: self.textures,
            mode: self.mode,
            joints: matches!(object.object.motion, Motion::Skinned { .. }).then_some(self.weights),
        }
    }
}

impl CacheOrigins {
    fn of(origins: &[Origin]) -> Self {
        let mut counts = Self::default();
        for origin in origins {
            match origin {
                Origin::Voxelized { replaces } => {
                    counts.voxelized += 1;
                    counts.replaced += usize::from(*replaces);
                }
                Origin::Kept => counts.kept += 1,
                Origin::Read => counts.read += 1,
            }
        }
        counts
    }
}
