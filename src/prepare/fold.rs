//! One matrix a part or joint: `grid_from_cache = grid_from_world · world_from_object ·
//! object_from_cache`, composed in f64 and rounded once. Far-away scenes cost no precision.

use std::collections::HashMap;

use glam::{DMat4, DVec3, IVec3};

use super::{Prepared, PreparedPart};
use crate::scene::{Motion, Pose};
use crate::settings::{MotionSettings, VoxelAnchor};
use crate::stages::transform::{Matrix3x4, Part};

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MotionError {
    #[error("{scene} has no clip \"{clip}\"; it has {known}")]
    UnknownClip { scene: String, clip: String, known: String },
}

/// What a frame uploads, and which parts are in the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameMatrices {
    pub matrices: Vec<Matrix3x4>,
    /// As many as [`Prepared::parts`]; `joints_skew` is left to whoever uploads the caches.
    pub parts: Vec<Part>,
    /// Whether a part may reach into the grid: the others leave it (Object I-O).
    pub resident: Vec<bool>,
    /// Objects left out of this frame because a matrix that moves them is not finite.
    pub left_out: Vec<usize>,
}

impl Prepared {
    /// Clip by name: the first where none is named, the rest pose for an empty name.
    pub fn clip_index(&self, motion: &MotionSettings) -> Result<Option<usize>, MotionError> {
        let clips = &self.scene.clips;
        let Some(name) = &motion.clip else { return Ok((!clips.is_empty()).then_some(0)) };
        if name.is_empty() {
            return Ok(None);
        }
        let index = clips.iter().position(|clip| &clip.name == name);
        index.map(Some).ok_or_else(|| MotionError::UnknownClip {
            scene: self.scene.name.clone(),
            clip: name.clone(),
            known: match clips.len() {
                0 => "none".to_owned(),
                _ => clips.iter().map(|clip| format!("\"{}\"", clip.name)).collect::<Vec<_>>().join(", "),
            },
        })
    }

    /// All world matrices, the turn applied.
    pub fn pose(&self, motion: &MotionSettings) -> Result<Pose, MotionError> {
        let mut pose = self.scene.pose(self.clip_index(motion)?, motion.time_secs);
        if motion.turn_degrees != [0.0; 3] {
            let turn = self.turn(motion);
            pose.world_from_node.iter_mut().for_each(|matrix| *matrix = turn * *matrix);
        }
        Ok(pose)
    }

    /// The rigid motion of everything: about the centre of the scene's bounds.
    pub fn turn(&self, motion: &MotionSettings) -> DMat4 {
        let [x, y, z] = motion.turn_degrees.map(f64::to_radians);
        let centre = self.bounds.map_or(DVec3::ZERO, |bounds| bounds.center());
        let rotation = DMat4::from_rotation_z(z) * DMat4::from_rotation_y(y) * DMat4::from_rotation_x(x);
        if motion.turn_degrees == [0.0; 3] {
            return DMat4::IDENTITY;
        }
        DMat4::from_translation(centre) * rotation * DMat4::from_translation(-centre)
    }

    /// Folds a pose into what the GPU reads.
    pub fn fold(&self, motion: &MotionSettings, anchor: VoxelAnchor) -> Result<FrameMatrices, MotionError> {
        let pose = self.pose(motion)?;
        let mut fold = Fold {
            prepared: self,
            grid_from_world: self.grid.grid_from_world(),
            turn: self.turn(motion),
            anchor,
            frame: FrameMatrices::default(),
            skins: HashMap::new(),
        };
        for part in &self.parts {
            let object = &self.objects[part.object].object;
            match object.motion {
                Motion::Skinned { skin } => fold.skinned_part(part, skin, &pose),
                _ => fold.rigid_part(part, &pose),
            }
        }
        Ok(fold.frame)
    }
}

struct Fold<'a> {
    prepared: &'a Prepared,
    grid_from_world: DMat4,
    turn: DMat4,
    anchor: VoxelAnchor,
    frame: FrameMatrices,
    skins: HashMap<usize, FoldedSkin>,
}

/// A skin's matrices are folded once, for all parts that share its lattice.
struct FoldedSkin {
    first_matrix: u32,
    base: IVec3,
    grid_from_cells: Vec<DMat4>,
}

impl Fold<'_> {
    fn rigid_part(&mut self, part: &PreparedPart, pose: &Pose) {
        let object = &self.prepared.objects[part.object];
        let moved = if object.lattice.is_grid() { self.turn } else { pose.world_from_node[object.object.node] };
        let grid_from_cells = self.grid_from_world * moved * object.lattice.space_from_cells();
        let first_matrix = self.frame.matrices.len() as u32;
        let finite = self.push_matrix(&grid_from_cells, part.tile.origin);
        let resident = finite && reaches_grid(&grid_from_cells, part, self.prepared.grid.cells());
        self.push_part(part, IVec3::ZERO, first_matrix, resident);
        self.note(part, finite);
    }

    fn skinned_part(&mut self, part: &PreparedPart, skin: usize, pose: &Pose) {
        if !self.skins.contains_key(&skin) {
            let folded = self.fold_skin(part, skin, pose);
            self.skins.insert(skin, folded);
        }
        let folded = &self.skins[&skin];
        let used = self.used_joints(part);
        let cells = self.prepared.grid.cells();
        let finite = used.iter().all(|&joint| folded.grid_from_cells[joint].is_finite());
        let resident = finite && used.iter().any(|&joint| reaches_grid(&folded.grid_from_cells[joint], part, cells));
        let (origin, first_matrix) = (part.tile.origin - folded.base, folded.first_matrix);
        self.push_part(part, origin, first_matrix, resident);
        self.note(part, finite);
    }

    /// All parts of one skin share one lattice; the smallest of their origins is folded in.
    fn fold_skin(&mut self, part: &PreparedPart, skin: usize, pose: &Pose) -> FoldedSkin {
        let prepared = self.prepared;
        let same_skin =
            |other: &&PreparedPart| prepared.objects[other.object].object.motion == Motion::Skinned { skin };
        let base = prepared.parts.iter().filter(same_skin).fold(IVec3::MAX, |base, other| base.min(other.tile.origin));
        let space_from_cells = prepared.objects[part.object].lattice.space_from_cells();
        let first_matrix = self.frame.matrices.len() as u32;
        let joints = prepared.scene.joint_matrices(skin, pose);
        let grid_from_cells: Vec<DMat4> =
            joints.iter().map(|joint| self.grid_from_world * *joint * space_from_cells).collect();
        for matrix in &grid_from_cells {
            self.push_matrix(matrix, base);
        }
        FoldedSkin { first_matrix, base, grid_from_cells }
    }

    fn used_joints(&self, part: &PreparedPart) -> Vec<usize> {
        let cache = &self.prepared.caches[self.prepared.objects[part.object].cache];
        let records = &cache.joints[part.tile.voxels.start as usize..part.tile.voxels.end as usize];
        let mut used: Vec<usize> = Vec::new();
        let mut seen = [0_u64; 1024];
        for record in records {
            for (&joint, _) in record.joints.iter().zip(&record.weights).filter(|&(_, &weight)| weight > 0) {
                let (word, bit) = (usize::from(joint) / 64, 1 << (joint % 64));
                if seen[word] & bit == 0 {
                    seen[word] |= bit;
                    used.push(usize::from(joint));
                }
            }
        }
        used
    }

    /// Folds origin and anchor into the translation, then rounds to f32 once. A matrix that is not
    /// finite is stored as zero: nothing reads it.
    fn push_matrix(&mut self, grid_from_cells: &DMat4, origin: IVec3) -> bool {
        let finite = grid_from_cells.is_finite();
        let matrix = if finite { *grid_from_cells } else { DMat4::ZERO };
        let first_cell = origin.as_dvec3();
        let translation = match self.anchor {
            VoxelAnchor::Centre => matrix.transform_point3(first_cell + 0.5),
            // Eq. 1: the moved corner is taken for the corner of an unturned cube.
            VoxelAnchor::Corner => matrix.transform_point3(first_cell) + 0.5,
        };
        let rows = [0, 1, 2].map(|axis| {
            let row = matrix.row(axis);
            [row.x as f32, row.y as f32, row.z as f32, translation[axis] as f32]
        });
        self.frame.matrices.push(Matrix3x4 { rows });
        finite
    }

    fn push_part(&mut self, part: &PreparedPart, origin: IVec3, first_matrix: u32, resident: bool) {
        let object = part.object as u32;
        self.frame.parts.push(Part { origin: origin.to_array(), first_matrix, object, ..Part::default() });
        self.frame.resident.push(resident);
    }

    fn note(&mut self, part: &PreparedPart, finite: bool) {
        if !finite && self.frame.left_out.last() != Some(&part.object) {
            self.frame.left_out.push(part.object);
        }
    }
}

/// Whether a part's box, moved, touches the grid or the guard layer around it.
fn reaches_grid(grid_from_cells: &DMat4, part: &PreparedPart, cells: u32) -> bool {
    let first = part.tile.origin.as_dvec3();
    let extent = part.extent_cells.as_dvec3();
    let corners = (0..8).map(|corner| {
        let offset = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2 & 1));
        grid_from_cells.transform_point3(first + extent * offset)
    });
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in corners {
        low = low.min(corner);
        high = high.max(corner);
    }
    low.cmple(DVec3::splat(f64::from(cells) + 1.0)).all() && high.cmpge(DVec3::splat(-1.0)).all()
}
