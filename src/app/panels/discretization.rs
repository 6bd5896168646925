//! What the voxels are made of: grid, span, what the grid is fit to, dense level, voxelization mode, anchor.

use std::collections::BTreeSet;

use egui::{ComboBox, DragValue, Slider, Ui};

use super::{choice, control, list};
use crate::app::command::Command;
use crate::settings::{Discretization, FitTo, ShotSettings, Visibility, VoxelAnchor, VoxelizationMode};

/// What the panel shows.
#[derive(Clone, Copy)]
pub struct DiscretizationPanel<'a> {
    pub discretization: &'a Discretization,
    pub shot: &'a ShotSettings,
    /// δ of the grid on screen, which "auto" has chosen or the setting says.
    pub span: Option<f64>,
    /// Of the scene tree.
    pub selected: Option<usize>,
}

pub fn ui(ui: &mut Ui, panel: DiscretizationPanel<'_>) -> Vec<Command> {
    let current = panel.discretization;
    let mut wanted = *current;
    control(ui, "Grid", "Cells along an axis. Voxelizes again; memory grows with the square.", |ui| {
        let combo = ComboBox::from_id_salt("grid").width(110.0).selected_text(format!("{0}³ cells", wanted.grid));
        combo
            .show_ui(ui, |ui| {
                for grid in Discretization::GRIDS {
                    ui.selectable_value(&mut wanted.grid, grid, format!("{grid}³ cells"));
                }
            })
            .response
    });
    span_ui(ui, &mut wanted, panel.span);
    let mut commands = fit_ui(ui, panel);
    let deepest = wanted.depth() - 1;
    let mut dense = wanted.deepest_dense();
    let tip = "Octree levels 0 to this one are stored densely: faster to reach, 8 times the memory a level.";
    if control(ui, "Dense to", tip, |ui| ui.add(Slider::new(&mut dense, 0..=deepest).prefix("level "))).changed() {
        wanted.dense_level = Some(dense);
    }
    let modes = [
        (VoxelizationMode::Thin, "Thin", "6-separating: the thinnest layer no axial step passes through."),
        (VoxelizationMode::Conservative, "Conservative", "Every cell a triangle touches: more voxels, no gaps."),
    ];
    choice(ui, "Cover", "Which cells a triangle fills. Voxelizes again.", &mut wanted.mode, &modes);
    let anchors = [
        (VoxelAnchor::Centre, "Centre", "Moves voxel centres."),
        (VoxelAnchor::Corner, "Corner", "Equation 1 to the letter: a turned voxel lands up to √3 cells off."),
    ];
    choice(ui, "Anchor", "Which point of a voxel the transformation moves.", &mut wanted.anchor, &anchors);
    if wanted != *current {
        commands.push(Command::Discretize(wanted));
    }
    commands
}

/// What the grid encloses, and which nodes count for it.
fn fit_ui(ui: &mut Ui, panel: DiscretizationPanel<'_>) -> Vec<Command> {
    let current = &panel.shot.fit;
    let mut wanted = current.clone();
    let mut kinds = vec![
        (FitTo::Clip, "Clip", "What counts, over the clip that is played; small things far from the rest do not."),
        (FitTo::Pose, "Pose", "What counts, at this moment: the finest cells, and another grid at every moment."),
        (FitTo::Scene, "Scene", "Everything, at rest and over all clips: one grid for all, with the coarsest cells."),
    ];
    if matches!(current.to, FitTo::Box { .. }) {
        kinds.push((current.to, "Box", "A box by its corners, as the command line or the settings say."));
    }
    list(ui, "Fit", "What the grid encloses. Voxelizes again.", &mut wanted.to, &kinds);
    let alone = panel.selected.map(|node| Visibility { only: BTreeSet::from([node]), ..Visibility::default() });
    let tip = "Which nodes the grid is fit to. Hiding nodes moves no grid by itself. Voxelizes again.";
    let counts = if current.counted.shows_all() {
        "all".to_owned()
    } else if !current.counted.only.is_empty() {
        format!("{} alone", current.counted.only.len())
    } else {
        format!("all but {}", current.counted.hidden.len())
    };
    control(ui, "Counts", tip, |ui| {
        ComboBox::from_id_salt("counted")
            .width(110.0)
            .selected_text(counts)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut wanted.counted, Visibility::default(), "All nodes");
                ui.selectable_value(&mut wanted.counted, panel.shot.visibility.clone(), "What is shown");
                if let Some(alone) = alone {
                    ui.selectable_value(&mut wanted.counted, alone, "The selected node");
                }
            })
            .response
    });
    if wanted == *current { Vec::new() } else { vec![Command::Fit(wanted)] }
}

fn span_ui(ui: &mut Ui, wanted: &mut Discretization, span: Option<f64>) {
    let mut automatic = wanted.span.is_none();
    let mut value = wanted.span.or(span).unwrap_or(1.0);
    let tip = "Edge of a leaf voxel in scene units (metres in glTF). Voxelizes again.";
    control(ui, "Span δ", tip, |ui| {
        let digits = (2.0 - value.log10().floor()).clamp(0.0, 12.0) as usize;
        let speed = value * 0.01;
        let drag = DragValue::new(&mut value).speed(speed).range(1e-9..=1e9).max_decimals(digits);
        let response = ui.add_enabled(!automatic, drag.update_while_editing(false));
        let auto = ui.checkbox(&mut automatic, "Auto span");
        auto.on_hover_text("What the grid is fit to fills it.");
        response
    });
    wanted.span = (!automatic).then_some(value);
}
