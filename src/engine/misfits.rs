//! What of the settings does not fit the scene or the grid, and what stands in for it: a sentence each.

use super::shadow_layouts::ShadowLayouts;
use crate::plan::{self, Asked};
use crate::prepare::Prepared;
use crate::settings::View;
use crate::stages::pixels::{shown_color, shown_level};

pub fn misfits(prepared: &Prepared, asked: &Asked, shadow_maps: &ShadowLayouts) -> Vec<String> {
    let depth = prepared.grid.depth;
    let found = [
        prepared.past_clip(&asked.settings.shot.motion),
        dense_level(asked),
        level(asked, depth),
        coloring(asked, depth),
        slice_width(asked, prepared.grid.cells()),
        shadow_maps.too_large.clone().filter(|_| plan::makes_shadow_maps(asked)),
        missing_map(asked),
    ];
    found.into_iter().flatten().collect()
}

fn dense_level(asked: &Asked) -> Option<String> {
    let discretization = &asked.settings.method.discretization;
    let (wanted, used) = (discretization.dense_level?, discretization.deepest_dense());
    (wanted > used && plan::builds_octree(asked)).then(|| {
        let (grid, leaves) = (discretization.grid, discretization.depth());
        format!(
            "dense level {wanted} does not fit a grid of {grid} cells, whose leaves are level {leaves}: \
             levels 0 to {used} are stored densely"
        )
    })
}

fn level(asked: &Asked, depth: u32) -> Option<String> {
    let look = &asked.settings.method.look;
    let wanted = look.level.filter(|level| look.view == View::Voxels && *level > depth)?;
    Some(format!("level {wanted} is not one of 0 (the root) to {depth} (the leaves): the leaves are shown"))
}

fn coloring(asked: &Asked, depth: u32) -> Option<String> {
    let look = &asked.settings.method.look;
    let differs = look.view == View::Voxels && shown_color(look, depth) != look.color;
    differs.then(|| format!("only leaves know their object: level {} is coloured by albedo", shown_level(look, depth)))
}

fn slice_width(asked: &Asked, grid_cells: u32) -> Option<String> {
    let look = &asked.settings.method.look;
    let width = look.slice.width_cells;
    (look.view == View::Slice && width > f64::from(grid_cells))
        .then(|| format!("samples of {width} cells are wider than the grid of {grid_cells}: the root is sampled"))
}

/// The light whose shadow map is wanted does not shine: the last one's is shown.
fn missing_map(asked: &Asked) -> Option<String> {
    let look = &asked.settings.method.look;
    let (number, last) = (look.shadow_map, asked.scene.lights.checked_sub(1)? as usize);
    (look.view == View::ShadowMap && number > last)
        .then(|| format!("there is no shadow map {number}: they are 0 to {last}, and {last} is shown"))
}
