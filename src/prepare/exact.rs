//! The truth that moved voxels are measured against: the posed mesh, voxelized on the grid itself.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};
use rayon::prelude::*;

use super::{MotionError, Prepared, PreparedObject};
use crate::data::albedo::unpack_color;
use crate::data::grid::morton_key;
use crate::data::packing::unpack_normal;
use crate::digest::Digest;
use crate::progress::{Cancelled, Progress};
use crate::scene::{AlphaMode, Pose};
use crate::settings::{Hidden, MotionSettings, VisibilityError};
use crate::stages::voxelize::{self, VoxelizeError, VoxelizeInput, VoxelizePart};

/// Cells that the posed triangles cover.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactVoxels {
    /// One bit a cell in Morton order, as the octree's leaf bits.
    pub bits: Vec<u32>,
    pub count: u64,
    /// Of what they are exact: pose, hidden objects and grid, as [`Prepared::placed`] tells.
    pub placed: Digest,
    /// Objects that could not be voxelized in this pose, a sentence each.
    pub warnings: Vec<String>,
}

/// A covered cell with what the surface looks like there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactVoxel {
    pub key: u32,
    pub albedo: [f64; 3],
    /// Share that masks and blended surfaces leave of the cell, 0 to 1: that of the object that covers most.
    pub coverage: f64,
    /// Mean over the objects in the cell; short where they disagree.
    pub normal: DVec3,
}

/// What the objects in a cell look like.
#[derive(Clone, Copy, Debug, Default)]
struct CellSum {
    objects: f64,
    albedo: [f64; 3],
    coverage: f64,
    normal: DVec3,
}

/// The covered cells sorted by Morton key, and a sentence for each object that could not be voxelized.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExactSurface {
    pub voxels: Vec<ExactVoxel>,
    pub warnings: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExactError {
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
}

impl Prepared {
    /// Exact voxelization of a pose, in the mode of the caches. Seconds for large scenes.
    pub fn exact(
        &self,
        motion: &MotionSettings,
        hidden: &Hidden,
        progress: &Progress,
    ) -> Result<ExactVoxels, ExactError> {
        let pose = self.pose(motion)?;
        let per_object = self.each_shown(hidden, progress, |object| self.posed_cells(object, &pose, progress))?;
        let words = (1_usize << (3 * self.grid.depth)).div_ceil(32);
        let placed = self.placed(&pose, hidden);
        let mut exact = ExactVoxels { bits: vec![0; words], count: 0, placed, warnings: Vec::new() };
        for cells in per_object {
            match cells {
                Ok(cells) => cells.iter().filter_map(|cell| self.key_inside(*cell)).for_each(|key| exact.insert(key)),
                Err(warning) => exact.warnings.push(warning),
            }
        }
        Ok(exact)
    }

    /// The same with albedo and normal.
    pub fn exact_voxels(
        &self,
        motion: &MotionSettings,
        hidden: &Hidden,
        progress: &Progress,
    ) -> Result<ExactSurface, ExactError> {
        let pose = self.pose(motion)?;
        let caches = self.each_shown(hidden, progress, |object| {
            let input = self.posed_input(object, &pose)?;
            progress.add_total(input.work_units());
            Some(voxelize::voxelize(&input, progress))
        })?;
        let mut warnings = Vec::new();
        let mut sums: BTreeMap<u32, CellSum> = BTreeMap::new();
        for cache in caches.into_iter().filter_map(|cache| cache.map_err(|warning| warnings.push(warning)).ok()) {
            for (cell, voxel) in cache.cells().zip(&cache.voxels) {
                let Some(key) = self.key_inside(cell) else { continue };
                let sum = sums.entry(key).or_default();
                let albedo = unpack_color(voxel.albedo);
                sum.objects += 1.0;
                (0..3).for_each(|channel| sum.albedo[channel] += albedo[channel]);
                sum.coverage = sum.coverage.max(albedo[3]);
                sum.normal += unpack_normal(voxel.normal);
            }
        }
        let mean = |(key, sum): (u32, CellSum)| ExactVoxel {
            key,
            albedo: sum.albedo.map(|channel| channel / sum.objects),
            coverage: sum.coverage,
            normal: sum.normal / sum.objects,
        };
        Ok(ExactSurface { voxels: sums.into_iter().map(mean).collect(), warnings })
    }

    /// Voxelizes every object that is not hidden, in parallel; `None` stands for one that is not at a
    /// finite place. What goes wrong with one object is a sentence that names it.
    fn each_shown<T: Send>(
        &self,
        hidden: &Hidden,
        progress: &Progress,
        voxelize: impl Fn(&PreparedObject) -> Option<Result<T, VoxelizeError>> + Sync,
    ) -> Result<Vec<Result<T, String>>, Cancelled> {
        let shown: Vec<&PreparedObject> =
            (0..).zip(&self.objects).filter(|(index, _)| !hidden.contains(*index)).map(|(_, object)| object).collect();
        progress.add_total(shown.len() as u64);
        let voxelize = |object: &PreparedObject| {
            let name = &object.object.name;
            let voxels = voxelize(object);
            progress.advance(1)?;
            match voxels {
                Some(Ok(voxels)) => Ok(Ok(voxels)),
                Some(Err(VoxelizeError::Cancelled(cancelled))) => Err(cancelled),
                Some(Err(cause)) => Ok(Err(format!("object \"{name}\": {cause}"))),
                None => Ok(Err(format!("object \"{name}\" is not at a finite place"))),
            }
        };
        shown.into_par_iter().map(voxelize).collect()
    }

    /// Key of a cell counted from the anchor, if the grid holds it.
    fn key_inside(&self, cell: IVec3) -> Option<u32> {
        let cell = cell - self.grid.offset_cells;
        let inside = cell.cmpge(IVec3::ZERO).all() && cell.cmplt(IVec3::splat(self.grid.cells() as i32)).all();
        inside.then(|| morton_key(cell.to_array().map(|c| c as u32)))
    }

    /// Cells that an object covers, counted from the anchor; `None` for one that is not at a finite
    /// place. What alpha cuts out covers nothing, so such objects are shaded as their caches were.
    fn posed_cells(
        &self,
        object: &PreparedObject,
        pose: &Pose,
        progress: &Progress,
    ) -> Option<Result<Vec<IVec3>, VoxelizeError>> {
        if self.has_cut_outs(object) {
            let input = self.posed_input(object, pose)?;
            progress.add_total(input.work_units());
            return Some(voxelize::voxelize(&input, progress).map(|cache| cache.cells().collect()));
        }
        let (positions, triangles) = self.posed_triangles(object, pose)?;
        let corner = self.grid.offset_cells;
        let clip = [corner, corner + IVec3::splat(self.grid.cells() as i32)];
        Some(voxelize::voxelize_cells(&positions, &triangles, self.mode, Some(clip)))
    }

    fn has_cut_outs(&self, object: &PreparedObject) -> bool {
        let materials = self.scene.meshes[object.object.mesh].primitives.iter().filter_map(|p| p.material);
        materials.into_iter().any(|material| self.scene.materials[material].alpha_mode != AlphaMode::Opaque)
    }

    /// Positions of all primitives in cells from the anchor and their triangles, renumbered.
    fn posed_triangles(&self, object: &PreparedObject, pose: &Pose) -> Option<(Vec<DVec3>, Vec<[u32; 3]>)> {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for (index, primitive) in self.scene.meshes[object.object.mesh].primitives.iter().enumerate() {
            let first = positions.len() as u32;
            positions.extend(self.primitive_cells(object, index, pose));
            triangles.extend(primitive.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        }
        positions.iter().all(|position| position.is_finite()).then_some((positions, triangles))
    }

    fn primitive_cells(&self, object: &PreparedObject, primitive: usize, pose: &Pose) -> Vec<DVec3> {
        let positions = self.scene.posed_positions(&object.object, primitive, pose);
        positions.into_iter().map(|position| self.grid.cells_from_anchor(position)).collect()
    }

    fn posed_input(&self, object: &PreparedObject, pose: &Pose) -> Option<VoxelizeInput<'_>> {
        let primitives = self.scene.meshes[object.object.mesh].primitives.iter().enumerate();
        let parts: Vec<VoxelizePart> = primitives
            .map(|(index, primitive)| VoxelizePart {
                primitive,
                positions_cells: self.primitive_cells(object, index, pose),
                normals: self.scene.posed_normals(&object.object, index, pose),
            })
            .collect();
        let finite = parts.iter().all(|part| part.positions_cells.iter().all(|position| position.is_finite()));
        finite.then(|| VoxelizeInput {
            parts,
            materials: &self.scene.materials,
            textures: &self.textures,
            mode: self.mode,
            joints: None,
        })
    }
}

impl ExactVoxels {
    fn insert(&mut self, key: u32) {
        let (word, bit) = (key as usize / 32, 1 << (key % 32));
        self.count += u64::from(self.bits[word] & bit == 0);
        self.bits[word] |= bit;
    }
}
