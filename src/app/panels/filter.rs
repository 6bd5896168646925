//! The filter switch, and beside it what each filter costs and misses for the scene on screen.

use egui::{Align, Button, Layout, RichText, Ui, vec2};

use super::{bytes, grouped};
use crate::app::command::Command;
use crate::app::numbers::{fixed, milliseconds};
use crate::app::palette::Tone;
use crate::engine::{AccuracyReport, FilterReport};
use crate::settings::{Filter, Settings};

/// Name, what it means, and its value for one filter.
type CostRow = (&'static str, &'static str, fn(&FilterReport) -> Option<String>);

const NAME_WIDTH: f32 = 72.0;
/// In place of what is measured, but not yet for the pose on screen.
const ON_ITS_WAY: &str = "on its way";

/// `report`: of the pose on screen; the filter not shown is in it where both are measured.
pub fn ui(ui: &mut Ui, settings: &Settings, report: Option<&AccuracyReport>) -> Vec<Command> {
    let costs = report.map_or([None, None], |report| [report.nearest, report.split]);
    let mut commands = Vec::new();
    ui.spacing_mut().item_spacing.y = 2.0;
    commands.extend(switch_ui(ui, settings));
    ui.add_space(3.0);
    let rows: [CostRow; 8] = [
        ("GPU time", "Kernel milliseconds of a full rebuild with this filter: the median of the last ones.", |cost| {
            Some(format!("{} ms", milliseconds(cost.times.spread.median_ms)))
        }),
        ("Spread", "From 5 % to 95 % of these times, and how many they are.", |cost| {
            let [low, high] = [cost.times.spread.p5_ms, cost.times.spread.p95_ms].map(milliseconds);
            Some(format!("{low}–{high}, {}×", cost.times.samples))
        }),
        ("Voxels", "Moved voxels inside the grid.", |cost| Some(grouped(cost.voxels))),
        ("Leaves", "Occupied leaf cells.", |cost| Some(grouped(cost.leaves))),
        ("Nodes", "Octree nodes of all levels, dummies included.", |cost| Some(grouped(cost.nodes))),
        ("Memory", "Bytes of the octree.", |cost| Some(bytes(cost.bytes))),
        ("Holes", "Cells of the exact posed voxelization that no moved voxel reached.", |cost| cost.holes.map(grouped)),
        ("Spill", "Cells that moved voxels reached outside the exact posed voxelization.", |cost| {
            cost.spill.map(grouped)
        }),
    ];
    for (name, tip, value) in rows {
        let is_compared = matches!(name, "Holes" | "Spill");
        let awaited = (is_compared && settings.method.look.accuracy).then(|| ON_ITS_WAY.to_owned());
        let values = costs.map(|cost| cost.as_ref().and_then(value).or_else(|| awaited.clone()));
        row_ui(ui, name, tip, values, settings.method.discretization.filter, row_color(name));
    }
    let exact_cells = report.and_then(|report| report.exact_cells);
    let share = |cost: Option<FilterReport>| Some(percent(cost?.holes?, exact_cells?));
    let tip = match exact_cells {
        Some(exact) => format!("Holes as a share of the {} exact cells.", grouped(exact)),
        None => "Holes as a share of the exact cells; known once measured.".to_owned(),
    };
    let awaited = settings.method.look.accuracy.then(|| ON_ITS_WAY.to_owned());
    let missed = costs.map(|cost| share(cost).or_else(|| awaited.clone()));
    row_ui(ui, "Missed", &tip, missed, settings.method.discretization.filter, None);
    commands.extend(measure_ui(ui, settings));
    commands
}

fn switch_ui(ui: &mut Ui, settings: &Settings) -> Option<Command> {
    let mut wanted = settings.method.discretization;
    ui.horizontal(|ui| {
        ui.add_space(NAME_WIDTH + ui.spacing().item_spacing.x);
        let width = column_width(ui);
        for (filter, name, tip) in [
            (Filter::Nearest, "Nearest", "A moved voxel fills the one cell its centre lies in."),
            (Filter::Split, "Split", "A moved voxel is split over the 8 cells it overlaps, by overlap."),
        ] {
            let text = RichText::new(name).size(14.0);
            let button = Button::selectable(wanted.filter == filter, text).frame_when_inactive(true);
            if ui.add(button.min_size(vec2(width, 28.0))).on_hover_text(tip).clicked() {
                wanted.filter = filter;
            }
        }
    });
    (wanted != settings.method.discretization).then_some(Command::Discretize(wanted))
}

/// Half of what is left, less the gap between the two columns.
fn column_width(ui: &Ui) -> f32 {
    (ui.available_width() - ui.spacing().item_spacing.x) / 2.0
}

fn row_ui(ui: &mut Ui, name: &str, tip: &str, values: [Option<String>; 2], filter: Filter, color: Option<Tone>) {
    let row = ui.horizontal(|ui| {
        let name = RichText::new(name).color(Tone::Weak.of(ui));
        sized(ui, NAME_WIDTH, Align::Min, |ui| ui.label(name));
        let width = column_width(ui);
        for (value, of) in values.into_iter().zip([Filter::Nearest, Filter::Split]) {
            let shown = if of == filter { Tone::Strong.of(ui) } else { ui.visuals().text_color() };
            let text = match value {
                Some(value) => RichText::new(value).color(color.map_or(shown, |tone| tone.of(ui))),
                None => RichText::new("–").color(Tone::Weak.of(ui)),
            };
            sized(ui, width, Align::Max, |ui| ui.label(text));
        }
    });
    row.response.on_hover_text(tip);
}

fn sized(ui: &mut Ui, width: f32, align: Align, add: impl FnOnce(&mut Ui) -> egui::Response) {
    let layout = match align {
        Align::Max => Layout::right_to_left(Align::Center),
        _ => Layout::left_to_right(Align::Center),
    };
    ui.allocate_ui_with_layout(vec2(width, 16.0), layout, |ui| {
        ui.set_min_width(width);
        if align == Align::Max {
            ui.add_space(6.0);
        }
        add(ui);
    });
}

fn row_color(name: &str) -> Option<Tone> {
    match name {
        "Holes" => Some(Tone::Hole),
        "Spill" => Some(Tone::Spill),
        _ => None,
    }
}

fn percent(cells: u64, exact: u64) -> String {
    format!("{} %", fixed(100.0 * cells as f64 / exact.max(1) as f64, 3))
}

fn measure_ui(ui: &mut Ui, settings: &Settings) -> Option<Command> {
    ui.add_space(3.0);
    let mut look = settings.method.look;
    let tip = "Builds with both filters and compares each with the exact voxelization of the pose. \
               Costs a second build on the GPU and a voxelization on the CPU for every pose.";
    ui.checkbox(&mut look.accuracy, "Measure both filters").on_hover_text(tip);
    (look != settings.method.look).then_some(Command::Look(look))
}
