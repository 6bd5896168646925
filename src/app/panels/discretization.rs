//! What the voxels are made of: grid, span, what the grid is fit to, dense level, voxelization mode, discretizer.

use std::collections::BTreeSet;

use egui::{ComboBox, DragValue, Role, Slider, Ui, WidgetInfo};

use super::{control, unfolding};
use crate::app::command::Command;
use crate::settings::{
    Discretization, Discretizer, FitTo, JointWeights, ShotSettings, Stretching, Visibility, VoxelAnchor,
    VoxelizationMode, VoxelizerCells,
};

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
    grid_ui(ui, &mut wanted);
    span_ui(ui, &mut wanted, panel.span);
    let mut commands = fit_ui(ui, panel);
    let deepest = wanted.depth() - 1;
    let mut dense = wanted.deepest_dense();
    let tip = "Octree levels 0 to this one are stored densely: faster to reach, 8 times the memory a level.";
    if control(ui, "Dense to", tip, |ui| ui.add(Slider::new(&mut dense, 0..=deepest).prefix("level "))).changed() {
        wanted.dense_level = Some(dense);
    }
    cover_ui(ui, &mut wanted);
    discretizer_ui(ui, &mut wanted);
    if wanted != *current {
        commands.push(Command::Discretize(wanted));
    }
    commands
}

/// How many cells there are, and which point of a voxel says in which of them it is.
fn grid_ui(ui: &mut Ui, wanted: &mut Discretization) {
    const ANCHORS: [(VoxelAnchor, &str, &str); 2] = [
        (VoxelAnchor::Centre, "Centre", "Moves voxel centres."),
        (VoxelAnchor::Corner, "Corner", "Equation 1 to the letter: a turned voxel lands up to √3 cells off."),
    ];
    let tip = "Cells along an axis, which voxelizes again: memory grows with the square. And which point of a voxel is moved.";
    control(ui, "Grid", tip, |ui| {
        ui.horizontal(|ui| {
            let grids = ComboBox::from_id_salt("grid").width(76.0).selected_text(format!("{0}³ cells", wanted.grid));
            let shown = grids.show_ui(ui, |ui| {
                for grid in Discretization::GRIDS {
                    ui.selectable_value(&mut wanted.grid, grid, format!("{grid}³ cells"));
                }
            });
            if wanted.discretizer == Discretizer::Transform {
                combo(ui, "Anchor", 50.0, &mut wanted.anchor, &ANCHORS);
            }
            shown.response
        })
        .inner
    });
}

/// Which cells a triangle fills, and which joints move them.
fn cover_ui(ui: &mut Ui, wanted: &mut Discretization) {
    const MODES: [(VoxelizationMode, &str, &str); 2] = [
        (VoxelizationMode::Thin, "Thin", "6-separating: the thinnest layer no axial step passes through."),
        (VoxelizationMode::Conservative, "Conservative", "Every cell a triangle touches: more voxels, no gaps."),
    ];
    const WEIGHTS: [(JointWeights, &str, &str); 2] = [
        (
            JointWeights::Interpolated,
            "Smooth",
            "Voxels of skins get joint weights interpolated between the corners of their triangles.",
        ),
        (
            JointWeights::Flat,
            "Flat",
            "Those of the nearest corner: as fast to move, coarser to bend. Enough for large cells.",
        ),
    ];
    let tip = "Which cells a triangle fills, and which joint weights voxels of skins get. Voxelizes again.";
    control(ui, "Cover", tip, |ui| {
        ui.horizontal(|ui| {
            combo(ui, "Coverage", 76.0, &mut wanted.mode, &MODES);
            combo(ui, "Joint weights", 46.0, &mut wanted.weights, &WEIGHTS);
        })
        .response
    });
}

/// What the grid encloses, and which nodes count for it.
fn fit_ui(ui: &mut Ui, panel: DiscretizationPanel<'_>) -> Vec<Command> {
    let current = &panel.shot.fit;
    let mut wanted = current.clone();
    let tip = "What the grid encloses, and which nodes count. Hiding nodes moves no grid by itself. Voxelizes again.";
    control(ui, "Fit", tip, |ui| {
        ui.horizontal(|ui| {
            to_ui(ui, &mut wanted.to);
            counted_ui(ui, &mut wanted.counted, panel);
        })
        .response
    });
    if wanted == *current { Vec::new() } else { vec![Command::Fit(wanted)] }
}

fn to_ui(ui: &mut Ui, to: &mut FitTo) {
    let current = *to;
    let mut kinds = vec![
        (FitTo::Clip, "Clip", "What counts, over the clip that is played; small things far from the rest do not."),
        (FitTo::Pose, "Pose", "What counts, at this moment: the finest cells, and another grid at every moment."),
        (FitTo::Scene, "Scene", "Everything, at rest and over all clips: one grid for all, with the coarsest cells."),
    ];
    if matches!(current, FitTo::Box { .. }) {
        kinds.push((current, "Box", "A box by its corners, as the command line or the settings say."));
    }
    combo(ui, "Fit to", 60.0, to, &kinds);
}

fn counted_ui(ui: &mut Ui, counted: &mut Visibility, panel: DiscretizationPanel<'_>) {
    let shown = if counted.shows_all() {
        "all nodes".to_owned()
    } else if !counted.only.is_empty() {
        format!("{} alone", counted.only.len())
    } else {
        format!("all but {}", counted.hidden.len())
    };
    let combo = ComboBox::from_id_salt("counted").width(80.0).selected_text(shown).show_ui(ui, |ui| {
        ui.selectable_value(counted, Visibility::default(), "all nodes");
        ui.selectable_value(counted, panel.shot.visibility.clone(), "what is shown");
        if let Some(node) = panel.selected {
            let alone = Visibility { only: BTreeSet::from([node]), ..Visibility::default() };
            ui.selectable_value(counted, alone, "the selected node");
        }
    });
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Nodes that count"));
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

/// Where the voxels of a frame come from, and what is open about that.
fn discretizer_ui(ui: &mut Ui, wanted: &mut Discretization) {
    const DISCRETIZERS: [(Discretizer, &str, &str); 2] = [
        (
            Discretizer::Transform,
            "Transform",
            "Every object is voxelized once and its voxels are moved: time follows voxels, and what stretches has holes.",
        ),
        (
            Discretizer::Voxelize,
            "Voxelize",
            "The posed triangles are voxelized every frame: no holes, no spill; time follows triangles and their cells.",
        ),
    ];
    const CELLS: [(VoxelizerCells, &str, &str); 2] = [
        (VoxelizerCells::Sparse, "Sparse", "A cell's fragments by a hash of it: memory follows what is covered."),
        (
            VoxelizerCells::Dense,
            "Dense",
            "A word for every cell of the grid, cleared every frame, as in the paper: 512 MiB at 512³.",
        ),
    ];
    const STRETCHING: [(Stretching, &str, &str); 2] = [
        (
            Stretching::Move,
            "Moved",
            "Objects that stretch are moved as all others, as in the paper: cheap, and their voxels come apart.",
        ),
        (
            Stretching::Voxelize,
            "Voxelized",
            "Objects that stretch by half a cell or more are voxelized every frame: no holes, for the time their triangles take.",
        ),
    ];
    control(ui, "By", "Where the voxels of a frame come from.", |ui| {
        ui.horizontal(|ui| {
            combo(ui, "Discretizer", 70.0, &mut wanted.discretizer, &DISCRETIZERS);
            match wanted.discretizer {
                Discretizer::Transform => {
                    combo(ui, "Stretching objects", 60.0, &mut wanted.stretching, &STRETCHING);
                }
                Discretizer::Voxelize => combo(ui, "Cells", 60.0, &mut wanted.cells, &CELLS),
            }
        })
        .response
    });
}

/// One of few, called what the label says.
fn combo<T: Copy + PartialEq>(ui: &mut Ui, label: &str, width: f32, value: &mut T, all: &[(T, &str, &str)]) {
    unfolding(ui, label, width, value, all).widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, label));
}
