//! Experiments: which is wanted, how far it is, and what it has found so far.

use egui::{Button, ProgressBar, RichText, ScrollArea, Ui, vec2};

use super::table::{self, Cell};
use super::{control, list, number, unless};
use crate::app::command::Command;
use crate::app::measuring::{Measure, Measuring, Order};
use crate::app::palette::Tone;
use crate::experiment::{Report, Table};

/// Of a digit, and around a column.
const CHARACTER_WIDTH: f32 = 6.5;
const COLUMN_MARGIN: f32 = 10.0;
/// Of Start and of Cancel.
const BUTTON_WIDTH: f32 = 54.0;

const MEASURES: [(Measure, &str, &str); 6] = [
    (Measure::Kernels, "Kernels", "Every kernel of a whole rebuild, beside what its memory traffic alone would take."),
    (
        Measure::Discretizers,
        "Discretizers",
        "Moving voxels, nearest and split, beside voxelizing the posed triangles, sparse and dense: time, holes, spill.",
    ),
    (
        Measure::Light,
        "Lighting",
        "Pointers, shadows, injection, averages and cones at the leaves, and samples a second.",
    ),
    (Measure::Surfaces, "Lit surfaces", "Lit surfaces against number and aperture of cones, resolution and sampling."),
    (Measure::Voxels, "Holes and spill", "Holes and spill of both filters against the posed mesh voxelized exactly."),
    (
        Measure::Shadows,
        "Shadows of lights",
        "Shadows of every light by five methods against rays through the posed triangles.",
    ),
];

pub fn ui(ui: &mut Ui, measuring: &Measuring, has_scene: bool) -> Vec<Command> {
    let mut orders = Vec::new();
    choose_ui(ui, measuring, &mut orders);
    run_ui(ui, measuring, has_scene, &mut orders);
    if measuring.report().is_some() {
        report_ui(ui, measuring, &mut orders);
    }
    orders.into_iter().map(Command::Measure).collect()
}

fn choose_ui(ui: &mut Ui, measuring: &Measuring, orders: &mut Vec<Order>) {
    unless(ui, measuring.is_busy().then_some("Something is being measured."), |ui| {
        let mut measure = measuring.measure;
        list(ui, "Measured", "What is measured: of the scene and the moment that are shown.", &mut measure, &MEASURES);
        if measure != measuring.measure {
            orders.push(Order::Choose(measure));
        }
        let mut runs = measuring.runs;
        let tip = "Frames that are measured, after one that is not; times are their medians.";
        control(ui, "Runs", tip, |ui| ui.add(number(&mut runs, Measuring::RUNS)));
        if runs != measuring.runs {
            orders.push(Order::Runs(runs));
        }
    });
}

/// As high while something is measured as before and after.
fn run_ui(ui: &mut Ui, measuring: &Measuring, has_scene: bool, orders: &mut Vec<Order>) {
    let progress = measuring.progress();
    ui.horizontal(|ui| {
        let (name, tip, order) = match progress {
            Some(_) => ("Cancel", "What is measured stays.", Order::Cancel),
            None => (
                "Start",
                "Builds the scene once more beside the picture: its octree and light take their memory twice, and the \
                 picture shares the GPU until the end. From seconds to minutes; more runs take longer.",
                Order::Start,
            ),
        };
        let button = ui.add_enabled(has_scene, Button::new(name).min_size(vec2(BUTTON_WIDTH, 0.0)));
        if button.on_hover_text(tip).clicked() {
            orders.push(order);
        }
        if let Some((fraction, _)) = progress {
            ui.add(ProgressBar::new(fraction).desired_width(120.0).show_percentage());
        }
    });
    let (note, tone) = match (progress, measuring.report()) {
        (Some((_, doing)), _) => (doing, Tone::Weak),
        (None, Some(report)) => (warnings(measuring, report), Tone::Warning),
        (None, None) => ("Nothing is measured yet.".to_owned(), Tone::Weak),
    };
    ui.add(egui::Label::new(RichText::new(note).color(tone.of(ui))).truncate());
}

/// What a report is not; empty where it is all of what is shown.
fn warnings(measuring: &Measuring, report: &Report) -> String {
    let cancelled = report.cancelled.then_some("It was cancelled: rows are missing.");
    let other = (!measuring.is_of_shown()).then_some("It is of another scene, moment or other settings than shown.");
    cancelled.into_iter().chain(other).collect::<Vec<_>>().join(" ")
}

fn report_ui(ui: &mut Ui, measuring: &Measuring, orders: &mut Vec<Order>) {
    for table in measuring.tables().iter().filter(|table| !table.rows.is_empty()) {
        table_ui(ui, table);
    }
    ui.horizontal(|ui| {
        if ui.button("Copy JSON").on_hover_text("All of the report, with adapter, driver and settings.").clicked() {
            orders.push(Order::Copy);
        }
        if ui.button("Save JSON").on_hover_text("The same into a file, in the folder of screenshots.").clicked() {
            orders.push(Order::Save);
        }
    });
}

/// As wide as its texts, whatever room there is.
fn table_ui(ui: &mut Ui, table: &Table) {
    let width = |column: usize, head: &str| {
        let cells = table.rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        cells.chain([head.chars().count()]).max().unwrap_or(0) as f32 * CHARACTER_WIDTH + COLUMN_MARGIN
    };
    let heads = table.heads.iter().enumerate();
    let columns: Vec<(&str, f32)> = heads.map(|(column, head)| (*head, width(column, head))).collect();
    let rows = table.rows.iter().map(|row| row.iter().map(|cell| Cell::new(cell.as_str())).collect());
    ScrollArea::horizontal().id_salt(table.stem).show(ui, |ui| {
        let spacing = ui.spacing().item_spacing.x * columns.len() as f32;
        ui.set_min_width(columns.iter().map(|(_, width)| width).sum::<f32>() + spacing);
        table::show(ui, table.stem, &columns, rows.collect());
    });
    ui.add_space(4.0);
}
