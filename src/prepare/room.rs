//! Whether the voxels of a scene fit an adapter, told before they are made: how many there will be is seen from the
//! triangles' areas.

use bytesize::ByteSize;
use glam::{DVec3, Vec3};

use super::{PrepareError, PreparedObject};
use crate::data::grid::Grid;
use crate::data::pages::{SEGMENT_SLOTS, WORLD_VOXEL_BYTES};
use crate::scene::bounds::Aabb;
use crate::scene::{Object, Pose, Primitive, Scene};
use crate::settings::Discretization;

/// What an adapter allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Room {
    pub adapter: String,
    pub buffer_bytes: u64,
}

impl Room {
    /// Refuses what will not fit, with what would. `first_users`: an object of each cache. At `pose`, of what lies
    /// outside the grid only the cache is on the adapter.
    pub(super) fn check(
        &self,
        (scene, pose): (&Scene, &dyn Fn() -> Pose),
        (grid, discretization): (&Grid, &Discretization),
        (objects, first_users): (&[PreparedObject], &[usize]),
    ) -> Result<(), PrepareError> {
        let of_cache: Vec<f64> = first_users.iter().map(|&user| expected_voxels(scene, &objects[user])).collect();
        let needed = |moved: &[&PreparedObject]| {
            let voxels: f64 = moved.iter().map(|object| of_cache[object.cache]).sum();
            let voxels = voxels.max(of_cache.iter().sum());
            let least = moved.len() as f64 * f64::from(SEGMENT_SLOTS);
            (voxels, least, voxels.max(least) * WORLD_VOXEL_BYTES as f64)
        };
        let fits = |bytes: f64| bytes <= self.buffer_bytes as f64;
        // Nothing is posed where all of it would fit.
        if fits(needed(&objects.iter().collect::<Vec<_>>()).2) {
            return Ok(());
        }
        let (voxels, least, bytes) = needed(&inside(scene, &pose(), grid, objects));
        if fits(bytes) {
            return Ok(());
        }
        let excess = bytes / self.buffer_bytes as f64;
        // As many objects need as much at any span.
        let would_fit =
            if least > voxels { "fewer objects".to_owned() } else { what_fits(grid, discretization, excess) };
        Err(PrepareError::NoRoom {
            scene: scene.name.clone(),
            millions: voxels / 1e6,
            span: grid.span,
            bytes: ByteSize(bytes as u64),
            limit: ByteSize(self.buffer_bytes),
            adapter: self.adapter.clone(),
            would_fit,
        })
    }
}

/// Objects that lie in the grid as a whole.
fn inside<'a>(scene: &Scene, pose: &Pose, grid: &Grid, objects: &'a [PreparedObject]) -> Vec<&'a PreparedObject> {
    let all: Vec<Object> = objects.iter().map(|object| object.object.clone()).collect();
    let (min, size) = (grid.corner(), grid.span * f64::from(grid.cells()));
    let is_inside = |bounds: &Aabb| bounds.min.cmpge(min).all() && bounds.max.cmple(min + size).all();
    let boxes = scene.boxes_at(&all, pose);
    objects.iter().zip(boxes).filter(|(_, bounds)| bounds.as_ref().is_some_and(is_inside)).map(|(o, _)| o).collect()
}

/// Voxels are as many as cells that a surface crosses, which a span twice as large makes a quarter.
fn what_fits(grid: &Grid, discretization: &Discretization, excess: f64) -> String {
    let coarser = excess.sqrt();
    let span = format!("a span of {:.2e}", grid.span * coarser * 1.05);
    let fits = |cells: &u32| f64::from(*cells) * coarser <= f64::from(grid.cells());
    match Discretization::GRIDS.into_iter().rev().find(fits) {
        Some(cells) if discretization.span.is_none() => format!("a grid of {cells}, or {span}"),
        _ => span,
    }
}

/// As many as a thin surface has: a column of cells across the main axis of each triangle; never more than its box.
fn expected_voxels(scene: &Scene, object: &PreparedObject) -> f64 {
    let of_primitive = |primitive: &Primitive| -> f64 {
        let in_cells = |position: &Vec3| object.lattice.cells_from_mesh(position.as_dvec3());
        let cells: Vec<DVec3> = primitive.positions.iter().map(in_cells).collect();
        let columns = primitive.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| cells[vertex as usize]);
            (b - a).cross(c - a).abs().max_element() / 2.0
        });
        let of_box =
            Aabb::from_points(cells.iter().copied()).map_or(0.0, |cells| (cells.size().ceil() + 1.0).element_product());
        columns.filter(|columns| columns.is_finite()).sum::<f64>().min(of_box)
    };
    scene.meshes[object.object.mesh].primitives.iter().map(of_primitive).sum()
}
