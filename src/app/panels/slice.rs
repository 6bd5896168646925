//! The plane through the octree: where it lies, what it shows, and how it is sampled.

use egui::Ui;

use super::{choice, control, list, slider};
use crate::settings::{Lookup, Sampling, Slice, SliceAxis, SliceValue};

pub fn ui(ui: &mut Ui, slice: &mut Slice) {
    let axes = [
        (SliceAxis::X, "Across x", "The plane of y and z."),
        (SliceAxis::Y, "Across y", "The plane of x and z: a floor plan."),
        (SliceAxis::Z, "Across z", "The plane of x and y."),
    ];
    choice(ui, "Plane", "Which axis the plane lies across.", &mut slice.axis, &axes);
    control(ui, "Height", "Where along that axis, as a share of the grid.", |ui| {
        ui.add(slider(&mut slice.height, 0.0..=1.0).max_decimals(4))
    });
    let values = [
        (SliceValue::Radiance, "Radiance", "Luminance of the mean radiance, nits."),
        (SliceValue::Irradiance, "Irradiance", "Luminance of the mean irradiance, lux."),
        (SliceValue::Occupancy, "Occupancy", "Occupied share, 0 to 1."),
    ];
    list(ui, "Value", "What the colours of the plane stand for.", &mut slice.value, &values);
    sampling_ui(ui, &mut slice.sampling);
    lookup_ui(ui, &mut slice.lookup);
    control(ui, "Width", "Of the samples in leaf cells: wide ones read levels further up.", |ui| {
        ui.add(slider(&mut slice.width_cells, Slice::WIDTHS_CELLS).logarithmic(true).max_decimals(1))
    });
    ui.checkbox(&mut slice.logarithmic, "Logarithmic").on_hover_text("Colours go with the logarithm of the value.");
}

pub fn sampling_ui(ui: &mut Ui, sampling: &mut Sampling) {
    let samplings = [
        (Sampling::Nearest, "Nearest node", "The node a place lies in."),
        (Sampling::Trilinear, "Trilinear", "The eight nodes around it, of one level."),
        (Sampling::Quadrilinear, "Quadrilinear", "Trilinear on two levels, blended by the width."),
    ];
    list(ui, "Sampling", "How a place between nodes gets its value.", sampling, &samplings);
}

pub fn lookup_ui(ui: &mut Ui, lookup: &mut Lookup) {
    let lookups = [
        (Lookup::Ranks, "Ranks", "Each by the rank of its bit in the block masks."),
        (Lookup::BlockPointers, "Block pointers", "By forward pointers stored once a block of eight nodes."),
        (Lookup::NodePointers, "Node pointers", "By forward pointers stored with every node, as in the paper."),
    ];
    let tip = "How the eight nodes are found. The values are the same, their cost is not: see the timings.";
    list(ui, "Look-up", tip, lookup, &lookups);
}
