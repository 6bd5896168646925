//! One matrix a part or joint: `grid_from_cache = grid_from_world · world_from_object ·
//! object_from_cache`, composed in f64 and rounded once. Far-away scenes cost no precision.

use std::collections::HashMap;

use glam::{DMat3, DMat4, DVec3, IVec3};

use super::{Lattice, Prepared, PreparedPart};
use crate::data::matrix::Matrix3x4;
use crate::data::voxel_cache::{Tile, VoxelCache};
use crate::scene::polar::unflattened;
use crate::scene::{Motion, Pose};
use crate::settings::{Hidden, MotionSettings, VoxelAnchor};
use crate::stages::transform::PartRecord;

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
    pub parts: Vec<PartRecord>,
    /// Whether a part may reach into the grid: the others leave it (Object I-O).
    pub resident: Vec<bool>,
    /// Objects left out of this frame because a matrix that moves them is not finite. Those that are
    /// hidden are not looked at.
    pub left_out: Vec<usize>,
}

impl Prepared {
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

    /// Folds a pose, which must be that of `motion`, into what the GPU reads. Parts that are hidden or outside
    /// the grid need no matrix: how those move changes nothing.
    pub fn fold(
        &self,
        (motion, pose): (&MotionSettings, &Pose),
        anchor: VoxelAnchor,
        hidden: &Hidden,
    ) -> FrameMatrices {
        let mut fold = Fold {
            prepared: self,
            grid_from_world: self.grid.grid_from_world(),
            turn: self.turn(motion),
            anchor,
            frame: FrameMatrices::default(),
            skins: HashMap::new(),
        };
        for part in &self.parts {
            let is_hidden = hidden.contains(part.object);
            match self.objects[part.object].object.motion {
                Motion::Skinned { .. } if is_hidden => fold.push_part(part, IVec3::ZERO, 0, false),
                Motion::Skinned { skin } => fold.skinned_part(part, skin, pose),
                Motion::Static | Motion::Rigid if is_hidden => fold.push_rigid(part, None),
                Motion::Static | Motion::Rigid => fold.rigid_part(part, pose),
            }
        }
        fold.frame
    }
}

/// Joints with a weight in any voxel of a tile, each once, in order.
pub(super) fn used_joints(cache: &VoxelCache, tile: &Tile) -> Vec<usize> {
    let records = &cache.joints[tile.voxels.start as usize..tile.voxels.end as usize];
    let mut is_used = vec![false; usize::from(u16::MAX) + 1];
    for record in records {
        for (&joint, _) in record.joints.iter().zip(&record.weights).filter(|&(_, &weight)| weight > 0) {
            is_used[usize::from(joint)] = true;
        }
    }
    (0..is_used.len()).filter(|&joint| is_used[joint]).collect()
}

/// The matrix of an object that is always flat, as if its voxels had a thickness.
fn with_thickness(world_from_node: &DMat4) -> DMat4 {
    let linear = unflattened(DMat3::from_mat4(*world_from_node));
    DMat4::from_translation(world_from_node.w_axis.truncate()) * DMat4::from_mat3(linear)
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
    /// `None` where the rounded matrix is not finite.
    grid_from_cells: Vec<Option<DMat4>>,
}

impl Fold<'_> {
    /// Every rigid part has a matrix, so that each finds its own; zero where nothing reads it.
    fn push_rigid(&mut self, part: &PreparedPart, matrix: Option<Matrix3x4>) {
        let first_matrix = self.frame.matrices.len() as u32;
        self.frame.matrices.push(matrix.unwrap_or_default());
        self.push_part(part, IVec3::ZERO, first_matrix, matrix.is_some());
    }

    fn rigid_part(&mut self, part: &PreparedPart, pose: &Pose) {
        let object = &self.prepared.objects[part.object];
        let moved = match &object.lattice {
            Lattice::Grid { .. } => self.turn,
            Lattice::Own { is_flat: true, .. } => with_thickness(&pose.world_from_node[object.object.node]),
            Lattice::Own { .. } => pose.world_from_node[object.object.node],
        };
        let grid_from_cells = self.grid_from_world * moved * object.lattice.space_from_cells();
        let rounded = self.rounded(&grid_from_cells, part.tile.origin);
        let reaches = object.may_leave_its_voxels()
            || MovedBox::of(&grid_from_cells, part).touches_grid(self.prepared.grid.cells());
        self.push_rigid(part, rounded.filter(|_| reaches));
        self.note(part, rounded.is_some());
    }

    /// A blended voxel is a weighted mean of where its joints would have it. No joint's image of the
    /// part need reach the grid for a mean between two to lie in it, but no mean leaves the box
    /// around all images.
    fn skinned_part(&mut self, part: &PreparedPart, skin: usize, pose: &Pose) {
        if !self.skins.contains_key(&skin) {
            let folded = self.fold_skin(part, skin, pose);
            self.skins.insert(skin, folded);
        }
        let folded = &self.skins[&skin];
        let used: Option<Vec<&DMat4>> =
            part.joints.iter().map(|&joint| folded.grid_from_cells[joint].as_ref()).collect();
        let reaches = |used: &Vec<&DMat4>| {
            if self.prepared.objects[part.object].may_leave_its_voxels() {
                return true;
            }
            let boxes = used.iter().map(|matrix| MovedBox::of(matrix, part));
            boxes.fold(MovedBox::EMPTY, MovedBox::union).touches_grid(self.prepared.grid.cells())
        };
        let resident = used.as_ref().is_some_and(reaches);
        let (origin, first_matrix, finite) = (part.tile.origin - folded.base, folded.first_matrix, used.is_some());
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
        let mut grid_from_cells = Vec::new();
        for joint in prepared.scene.joint_matrices(skin, pose) {
            let matrix = self.grid_from_world * joint * space_from_cells;
            let rounded = self.rounded(&matrix, base);
            grid_from_cells.push(rounded.map(|_| matrix));
            self.frame.matrices.push(rounded.unwrap_or_default());
        }
        FoldedSkin { first_matrix, base, grid_from_cells }
    }

    /// Folds origin and anchor into the translation, then rounds to f32 once. `None` if that is not
    /// finite: numbers that an f64 holds may be too large for an f32.
    fn rounded(&self, grid_from_cells: &DMat4, origin: IVec3) -> Option<Matrix3x4> {
        let first_cell = origin.as_dvec3();
        let translation = match self.anchor {
            VoxelAnchor::Centre => grid_from_cells.transform_point3(first_cell + 0.5),
            // Eq. 1: the moved corner is taken for the corner of an unturned cube.
            VoxelAnchor::Corner => grid_from_cells.transform_point3(first_cell) + 0.5,
        };
        let rows = [0, 1, 2].map(|axis| {
            let row = grid_from_cells.row(axis);
            [row.x as f32, row.y as f32, row.z as f32, translation[axis] as f32]
        });
        rows.as_flattened().iter().all(|entry| entry.is_finite()).then_some(Matrix3x4 { rows })
    }

    fn push_part(&mut self, part: &PreparedPart, origin: IVec3, first_matrix: u32, resident: bool) {
        let object = part.object as u32;
        self.frame.parts.push(PartRecord { origin: origin.to_array(), first_matrix, object, ..PartRecord::default() });
        self.frame.resident.push(resident);
    }

    fn note(&mut self, part: &PreparedPart, finite: bool) {
        if !finite && self.frame.left_out.last() != Some(&part.object) {
            self.frame.left_out.push(part.object);
        }
    }
}

/// The box around a part's moved box, in cells of the grid.
#[derive(Clone, Copy)]
struct MovedBox {
    low: DVec3,
    high: DVec3,
}

impl MovedBox {
    const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn of(grid_from_cells: &DMat4, part: &PreparedPart) -> Self {
        let first = part.tile.origin.as_dvec3();
        let extent = part.extent_cells.as_dvec3();
        let corners = (0..8).map(|corner| {
            let offset = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2 & 1));
            grid_from_cells.transform_point3(first + extent * offset)
        });
        corners.fold(Self::EMPTY, |all, corner| all.union(Self { low: corner, high: corner }))
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether it touches the grid or the guard layer around it.
    fn touches_grid(&self, cells: u32) -> bool {
        let reaches_up = self.low.cmple(DVec3::splat(f64::from(cells) + 1.0)).all();
        reaches_up && self.high.cmpge(DVec3::splat(-1.0)).all()
    }
}
