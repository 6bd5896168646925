//! GPU time per kernel of the last frame that ran, what it moved, and the frames before.

use egui::{RichText, Ui};
use egui_plot::{Bar, BarChart, GridMark, Plot};

use super::table::{self, Cell};
use super::{bytes, grouped, nothing};
use crate::app::history::{FrameHistory, KernelSum, LENGTH, by_kernel, total_ms};
use crate::app::latency::Latency;
use crate::app::numbers::{fixed, milliseconds};
use crate::app::palette::Tone;
use crate::engine::PassTiming;

/// `timings`: of the results on screen, which frames before `last_frame` may have made.
pub fn ui(ui: &mut Ui, (timings, last_frame): (&[PassTiming], u64), history: &FrameHistory, latency: &Latency) {
    latency_ui(ui, latency);
    if timings.is_empty() {
        nothing(ui, "No frame has run on the GPU yet.");
        return;
    }
    history_ui(ui, history);
    let total = total_ms(timings);
    let mut rows = vec![vec![
        Cell::new("All on screen").color(Tone::Strong).tip("Bright: run by the last frame. Grey: kept from before."),
        Cell::new(milliseconds(total)).color(Tone::Strong),
        Cell::new(""),
        Cell::new(""),
    ]];
    rows.extend(by_kernel(timings).iter().map(|kernel| row(kernel, total, kernel.frame == last_frame)));
    table::show(ui, "timings", &[("kernel", 0.0), ("ms", 44.0), ("share", 52.0), ("GB/s", 40.0)], rows);
}

fn latency_ui(ui: &mut Ui, latency: &Latency) {
    let text = match (latency.p95_ms(), latency.last_ms()) {
        (Some(p95), Some(last)) => format!("p95 {} ms, last {} ms", milliseconds(p95), milliseconds(last)),
        _ => "not measured yet".to_owned(),
    };
    let row = ui.horizontal(|ui| {
        ui.label(RichText::new("Input to paint").color(Tone::Weak.of(ui)));
        ui.label(text);
    });
    let tip =
        "From an input to the end, on the GPU, of the frame that shows it; 95 % of the last inputs stayed within p95.";
    row.response.on_hover_text(tip);
}

/// A bar a frame; the tallest gives the scale.
fn history_ui(ui: &mut Ui, history: &FrameHistory) {
    let bars = history.gpu_ms().enumerate().map(|(frame, ms)| Bar::new(frame as f64, ms).width(0.8));
    let chart = BarChart::new("GPU time", bars.collect()).color(Tone::Accent.of(ui)).allow_hover(false);
    let most = history.gpu_ms().fold(1.0, f64::max);
    let marks = move |_| [0.0, most / 2.0, most].map(|value| GridMark { value, step_size: most }).to_vec();
    let plot = Plot::new("gpu history")
        .height(72.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(false)
        .show_axes([false, true])
        .y_axis_min_width(28.0)
        .include_x(0.0)
        .include_x(LENGTH as f64)
        .include_y(0.0)
        .y_grid_spacer(marks)
        .y_axis_formatter(|mark, _| milliseconds(mark.value))
        .show_grid([false, true])
        .set_margin_fraction(egui::vec2(0.01, 0.08));
    let response = plot.show(ui, |plot| plot.bar_chart(chart)).response;
    response.on_hover_text("GPU milliseconds of the last frames that ran.");
}

fn row(KernelSum { timing: kernel, .. }: &KernelSum, total_ms: f64, has_run: bool) -> Vec<Cell> {
    let share = if total_ms > 0.0 { kernel.ms / total_ms } else { 0.0 };
    let rate = kernel.bytes_moved as f64 / (kernel.ms * 1e6);
    let tip =
        format!("{}: {} threads, must move {}", kernel.kernel, grouped(kernel.threads), bytes(kernel.bytes_moved));
    let color = if has_run { Tone::Strong } else { Tone::Weak };
    vec![
        Cell::new(&kernel.kernel).color(color).tip(tip),
        Cell::new(milliseconds(kernel.ms)).color(color),
        Cell::new(format!("{} %", fixed(share * 100.0, 0))).bar(share as f32),
        if kernel.bytes_moved > 0 && rate.is_finite() { Cell::new(fixed(rate, 1)) } else { Cell::new("–") },
    ]
}
