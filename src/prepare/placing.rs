//! Where the grid and every object's lattice lie (section 4.2, Eq. 2). The grid's corner is the scene's anchor plus
//! integers · δ, so nothing depends on world zero.

use std::collections::HashMap;

use glam::{DMat4, DVec3, IVec3};

use super::lattice::Lattice;
use super::{PrepareError, PreparedObject};
use crate::data::grid::Grid;
use crate::data::packing::unpack_position;
use crate::data::voxel_cache::{Tile, VoxelCache};
use crate::scene::bounds::Aabb;
use crate::scene::polar::unflattened;
use crate::scene::{Motion, MotionReport, Object, Pose, Scene, Warning};
use crate::settings::Discretization;

/// Cells left free around the scene, so that rounding touches no border.
const MARGIN_CELLS: u32 = 1;

/// Scenes this wide still have exact cell numbers in 32 bits, whatever is added to them.
const MAX_SCENE_CELLS: f64 = (1 << 30) as f64;

/// The grid around the scene's posed bounds, centred by whole cells.
pub fn grid_around(scene: &str, bounds: Option<Aabb>, discretization: &Discretization) -> Result<Grid, PrepareError> {
    let cells = discretization.grid;
    if !Discretization::GRIDS.contains(&cells) {
        return Err(PrepareError::Grid(cells));
    }
    let (anchor, size) = bounds.map_or((DVec3::ZERO, DVec3::ZERO), |bounds| (bounds.min, bounds.size()));
    let fitting = size.max_element() / f64::from(cells - 2 * MARGIN_CELLS);
    let span = discretization.span.unwrap_or(if fitting > 0.0 { fitting } else { 1.0 });
    if !(span.is_finite() && span > 0.0) {
        return Err(PrepareError::Span(span));
    }
    let cells_wide = size.max_element() / span;
    if cells_wide.is_nan() || cells_wide > MAX_SCENE_CELLS {
        let scene = scene.to_owned();
        return Err(PrepareError::TooWide { scene, span, cells: cells_wide, limit: MAX_SCENE_CELLS });
    }
    // Rounded off-centre: scenes whose extents are simple ratios would sit on a tie, and a last-bit
    // difference in their bounds would shift the grid by a cell.
    let free = (DVec3::splat(f64::from(cells)) - size / span) / 2.0;
    let offset_cells = -(free + 0.381_966).floor().as_ivec3();
    Ok(Grid { anchor, offset_cells, span, depth: discretization.depth() })
}

/// Still objects that share a mesh lie where they stand, each with voxels of its own, as long as these are made from
/// fewer triangles.
const MOST_STILL_TRIANGLES: usize = 1 << 22;

/// The objects that can be seen at some time, each on its lattice, and a warning for each mesh whose still objects share
/// voxels. `cache` is numbered later.
pub fn visible_objects(scene: &Scene, grid: &Grid, motion: MotionReport) -> (Vec<PreparedObject>, Vec<Warning>) {
    let unmovable = motion.unmovable();
    let MotionReport { objects, hidden, .. } = motion;
    let rest = scene.pose(None, 0.0);
    // The nodes of its still objects, by mesh.
    let mut shared: HashMap<usize, Vec<usize>> = HashMap::new();
    for object in objects.iter().filter(|object| object.motion == Motion::Static) {
        shared.entry(object.mesh).or_default().push(object.node);
    }
    let too_many = |mesh: usize, count: usize| count * scene.meshes[mesh].triangle_count() > MOST_STILL_TRIANGLES;
    shared.retain(|&mesh, nodes| nodes.len() > 1 && too_many(mesh, nodes.len()));
    let mut warnings: Vec<Warning> = shared.iter().map(|(&mesh, nodes)| share_warning(scene, mesh, nodes)).collect();
    warnings.sort_by(|a, b| a.sentence.cmp(&b.sentence));
    let visible = objects.into_iter().enumerate().filter(|(index, _)| !hidden.contains(index));
    let prepared = visible.map(|(index, object)| {
        let stands = !shared.contains_key(&object.mesh) && is_countable(scene, &object, &rest, grid);
        let lattice = lattice_of(&object, &rest, grid, stands);
        PreparedObject { object, cache: 0, lattice, unmovable: unmovable.get(&index).copied() }
    });
    (prepared.collect(), warnings)
}

fn share_warning(scene: &Scene, mesh: usize, nodes: &[usize]) -> Warning {
    let sentence = format!(
        "mesh \"{}\": its {} still objects share voxels, which are moved to where they stand and fall up to half a \
         cell beside; voxels of their own would be made from more than {MOST_STILL_TRIANGLES} triangles",
        scene.meshes[mesh].name,
        nodes.len()
    );
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    Warning { nodes, ..Warning::new(sentence) }
}

/// Whether the cells of a still object can be counted from the grid's anchor. One at no finite place, or too far, is as
/// one that moves: it is left out, and named.
fn is_countable(scene: &Scene, object: &Object, rest: &Pose, grid: &Grid) -> bool {
    let corners = scene.mesh_box(object.mesh).into_iter().flat_map(|bounds| bounds.corners());
    let world_from_mesh = rest.world_from_node[object.node];
    let mut cells = corners.map(|corner| grid.cells_from_anchor(world_from_mesh.transform_point3(corner)));
    cells.all(|cells| cells.is_finite() && cells.abs().max_element() <= MAX_SCENE_CELLS / 2.0)
}

fn lattice_of(object: &Object, rest: &Pose, grid: &Grid, stands: bool) -> Lattice {
    if object.motion == Motion::Static && stands {
        return Lattice::Grid { grid: *grid, world_from_mesh: rest.world_from_node[object.node] };
    }
    let thick = unflattened(object.stretch);
    Lattice::Own {
        cells_from_mesh: DMat4::from_scale(DVec3::splat(1.0 / grid.span)) * DMat4::from_mat3(object.stretch),
        space_from_cells: DMat4::from_mat3(thick.inverse()) * DMat4::from_scale(DVec3::splat(grid.span)),
        is_flat: thick != object.stretch,
    }
}

/// Largest position of a tile's voxels, plus one, per axis.
pub fn tile_extent(cache: &VoxelCache, tile: &Tile) -> IVec3 {
    let voxels = &cache.voxels[tile.voxels.start as usize..tile.voxels.end as usize];
    voxels.iter().fold(IVec3::ZERO, |extent, voxel| {
        extent.max(IVec3::from_array(unpack_position(voxel.position).map(|c| c as i32 + 1)))
    })
}
