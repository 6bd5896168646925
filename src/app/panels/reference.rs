//! The path tracer beside the cones: starts and stops it, says how far it is and how sure, lays it over the
//! picture, and lists how far cones are off.

use egui::{Button, ProgressBar, RichText, Ui, vec2};

use super::table::{self, Cell};
use super::{choice, control, nothing, number, slider, unless};
use crate::accuracy::picture_error::PictureError;
use crate::app::command::Command;
use crate::app::numbers::{duration, milliseconds, short};
use crate::app::palette::Tone;
use crate::app::reference::{Comparison, MeasuredPart, Order, PARTS, Reference, Traced};
use crate::engine::PassTiming;
use crate::experiment::SurfaceWork;
use crate::plan::Part;
use crate::settings::SurfaceView;

/// Of Start and of Stop.
const BUTTON_WIDTH: f32 = 48.0;

pub struct ReferencePanel<'a> {
    pub reference: &'a Reference,
    /// Of the picture that is shown.
    pub timings: &'a [PassTiming],
    pub is_surfaces: bool,
    pub has_scene: bool,
}

/// All rows are there from the start, so that nothing moves when a run begins or ends.
pub fn ui(ui: &mut Ui, panel: &ReferencePanel<'_>) -> Vec<Command> {
    let reference = panel.reference;
    let mut orders = Vec::new();
    run_ui(ui, panel, &mut orders);
    restart_ui(ui, reference, &mut orders);
    progress_ui(ui, reference);
    state_ui(ui, panel);
    compare_ui(ui, panel, &mut orders);
    errors_ui(ui, reference.traced(), reference.measured());
    times_ui(ui, panel.timings, reference.traced());
    orders.into_iter().map(Command::Reference).collect()
}

fn run_ui(ui: &mut Ui, panel: &ReferencePanel<'_>, orders: &mut Vec<Order>) {
    let reference = panel.reference;
    let mut samples = reference.samples;
    let tip = "Paths a pixel to end with; four times as many err half as much.";
    control(ui, "Samples", tip, |ui| {
        let response = ui.add(number(&mut samples, Reference::SAMPLES));
        let (name, tip, order) = match reference.fraction() {
            None => (
                "Start",
                "Traces paths through the picture that is shown, on all cores but one; goes on where the same picture \
                 was stopped.",
                Order::Start,
            ),
            Some(_) => ("Stop", "What is traced is kept, and Start goes on from there.", Order::Stop),
        };
        let button = ui.add_enabled(panel.has_scene, Button::new(name).min_size(vec2(BUTTON_WIDTH, 0.0)));
        if button.on_hover_text(tip).clicked() {
            orders.push(order);
        }
        response
    });
    if samples != reference.samples {
        orders.push(Order::Samples(samples));
    }
}

fn restart_ui(ui: &mut Ui, reference: &Reference, orders: &mut Vec<Order>) {
    let mut restarts = reference.restarts;
    let tip = "Another camera, pose, scene or light is traced from the first sample on, once it rests: all cores but one \
               stay at work, and what was traced before is lost. Without it, a run stops when its picture is gone.";
    if ui.checkbox(&mut restarts, "Restart when the view changes").on_hover_text(tip).changed() {
        orders.push(Order::Restart(restarts));
    }
}

/// As high where nothing is traced.
fn progress_ui(ui: &mut Ui, reference: &Reference) {
    ui.horizontal(|ui| {
        let Some(fraction) = reference.fraction() else { return };
        ui.add(ProgressBar::new(fraction).desired_width(150.0).show_percentage());
        let left = reference.secs_left().map_or(String::new(), |secs| format!("about {} left", duration(secs)));
        ui.label(RichText::new(left).color(Tone::Weak.of(ui)));
    });
}

/// What there is, and what it is of: as high whatever it says.
fn state_ui(ui: &mut Ui, panel: &ReferencePanel<'_>) {
    let reference = panel.reference;
    let samples = match reference.traced() {
        None => RichText::new("Nothing is traced yet.").color(Tone::Weak.of(ui)),
        Some(traced) => {
            let error = traced.part(SurfaceView::Final).and_then(|part| part.relative_error);
            let error = error.map_or(String::new(), |error| format!(", standard error {} %", short(100.0 * error)));
            let plural = if traced.samples == 1 { "" } else { "s" };
            RichText::new(format!("{} sample{plural}, {} s{error}", traced.samples, short(traced.secs)))
        }
    };
    ui.label(samples).on_hover_text("Of a pixel: root mean square over the picture, in parts of its mean luminance.");
    let lines = 2.0 * ui.text_style_height(&egui::TextStyle::Body);
    ui.allocate_ui(vec2(ui.available_width(), lines), |ui| {
        ui.set_min_height(lines);
        if let Some(sentence) = reference.stopped() {
            ui.label(RichText::new(sentence).color(Tone::Warning.of(ui)));
        } else if reference.traced().is_some() && !reference.is_of_shown() {
            let sentence = "It is of another picture: camera, scene or light have changed.";
            ui.label(RichText::new(sentence).color(Tone::Warning.of(ui)));
        } else if !panel.is_surfaces {
            nothing(ui, "The view \"Surfaces\" is compared with it.");
        }
    });
}

fn compare_ui(ui: &mut Ui, panel: &ReferencePanel<'_>, orders: &mut Vec<Order>) {
    let reference = panel.reference;
    let mut comparison = reference.comparison;
    let ways = [
        (Comparison::Cones, "Cones", "The picture alone."),
        (Comparison::Paths, "Paths", "The path-traced picture in its place."),
        (Comparison::Wipe, "Wipe", "Cones left of a divider that may be dragged, paths right of it."),
        (Comparison::Difference, "Difference", "Red where cones are brighter than paths, blue where they are darker."),
    ];
    if choice(ui, "Compare", "What lies over the picture.", &mut comparison, &ways) {
        orders.push(Order::Compare(comparison));
    }
    unless(ui, (comparison != Comparison::Wipe).then_some("Nothing is wiped."), |ui| {
        let mut divider = reference.divider;
        let place = slider(&mut divider, 0.0..=1.0).max_decimals(2);
        if control(ui, "Divider", "Its place, from left to right.", |ui| ui.add(place)).changed() {
            orders.push(Order::Divide(divider));
        }
    });
}

fn errors_ui(ui: &mut Ui, traced: Option<&Traced>, measured: &[MeasuredPart]) {
    let rows = PARTS.into_iter().map(|part| {
        let error = measured.iter().find(|measured| measured.part == part);
        let cell = |value: Option<f64>| Cell::new(value.map_or("–".to_owned(), short));
        let of = |value: fn(&PictureError) -> f64| cell(error.map(|e| value(&e.error)));
        vec![
            Cell::new(name(part)),
            of(|error| error.rel_mse),
            of(|error| error.bias),
            of(|error| error.ssim),
            cell(error.and_then(|error| error.error.flip)),
            cell(traced.and_then(|traced| traced.part(part)?.relative_error)),
        ]
    });
    let columns = [("part", 0.0), ("relMSE", 52.0), ("bias", 52.0), ("SSIM", 44.0), ("FLIP", 44.0), ("± paths", 50.0)];
    table::show(ui, "errors of cones", &columns, rows.collect());
}

fn name(part: SurfaceView) -> &'static str {
    match part {
        SurfaceView::Direct => "Direct",
        SurfaceView::Diffuse => "Diffuse",
        SurfaceView::Specular => "Specular",
        SurfaceView::Ao => "Occlusion",
        _ => "Final",
    }
}

fn times_ui(ui: &mut Ui, timings: &[PassTiming], traced: Option<&Traced>) {
    let is_shown = |timing: &&PassTiming| timing.pass.parts() == [Part::Picture];
    let of_view: f64 = timings.iter().filter(is_shown).map(|timing| timing.kernel.ms).sum();
    let [of_cones, of_surfaces] =
        [&SurfaceWork::CONES[..], &SurfaceWork::ALL[..]].map(|works| SurfaceWork::sum_ms(works, timings));
    let (cones, picture) = (milliseconds(of_cones), milliseconds(of_surfaces + of_view));
    let paths = traced.map_or("–".to_owned(), |traced| format!("{} s", short(traced.secs)));
    let text = format!("Cones {cones} ms, all of the picture {picture} ms; paths {paths}");
    ui.label(RichText::new(text).color(Tone::Weak.of(ui))).on_hover_text(
        "Time on the GPU of the picture that is shown, octree and its light not counted; paths on the CPU.",
    );
}
