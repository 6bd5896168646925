//! What the voxels are made of: grid, span, dense level, voxelization mode, anchor.

use egui::{ComboBox, DragValue, Slider, Ui};

use super::{choice, control};
use crate::app::command::Command;
use crate::settings::VoxelizationMode;
use crate::settings::{Discretization, VoxelAnchor};

/// `span`: δ of the grid on screen, which "auto" has chosen or the setting says.
pub fn ui(ui: &mut Ui, current: &Discretization, span: Option<f64>) -> Vec<Command> {
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
    span_ui(ui, &mut wanted, span);
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
    if wanted == *current { Vec::new() } else { vec![Command::Discretize(wanted)] }
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
        auto.on_hover_text("The bounds of the scene over all its animation fill the grid.");
        response
    });
    wanted.span = (!automatic).then_some(value);
}
