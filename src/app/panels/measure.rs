//! Experiments: which is wanted, how far it is, and what it has found so far.

use egui::{Button, ProgressBar, RichText, ScrollArea, Ui};

use super::table::{self, Cell};
use super::{control, list, nothing, number, unless};
use crate::app::command::Command;
use crate::app::measuring::{Measure, Measuring, Order};
use crate::app::theme;
use crate::experiment::{Report, Table};

/// Of a digit, and around a column.
const CHARACTER_WIDTH: f32 = 6.5;
const COLUMN_MARGIN: f32 = 10.0;

const MEASURES: [(Measure, &str, &str); 5] = [
    (Measure::Kernels, "Kernels", "Every kernel of a whole rebuild, beside what its memory traffic alone would take."),
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
    match measuring.report() {
        None => nothing(ui, "Nothing is measured yet."),
        Some(report) => report_ui(ui, (measuring, report), &mut orders),
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

fn run_ui(ui: &mut Ui, measuring: &Measuring, has_scene: bool, orders: &mut Vec<Order>) {
    let Some((fraction, doing)) = measuring.progress() else {
        let tip = "Builds the scene once more beside the picture: its octree and light take their memory twice, and \
                   the picture shares the GPU until the end. From seconds to minutes; more runs take longer.";
        if ui.add_enabled(has_scene, Button::new("Start")).on_hover_text(tip).clicked() {
            orders.push(Order::Start);
        }
        return;
    };
    ui.horizontal(|ui| {
        if ui.button("Cancel").on_hover_text("What is measured stays.").clicked() {
            orders.push(Order::Cancel);
        }
        ui.add(ProgressBar::new(fraction).desired_width(120.0).show_percentage());
    });
    ui.add(egui::Label::new(RichText::new(doing).color(theme::WEAK)).truncate());
}

fn report_ui(ui: &mut Ui, (measuring, report): (&Measuring, &Report), orders: &mut Vec<Order>) {
    if !measuring.is_of_shown() {
        ui.label(RichText::new("It is of another scene, moment or other settings than shown.").color(theme::WARNING));
    }
    if report.cancelled {
        ui.label(RichText::new("It was cancelled: rows are missing.").color(theme::WARNING));
    }
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
