//! The bar above everything: what is open, what the program is doing, and the panels' switches.

use egui::{Align, Layout, ProgressBar, RichText, Ui};

use crate::app::command::Command;
use crate::app::theme;

/// What is shown; nothing here is kept.
pub struct TopBar<'a> {
    pub scene: Option<&'a str>,
    /// What is going on and how far, which may be cancelled.
    pub loading: Option<(&'a str, f32)>,
    /// How far the frame is that the GPU works on.
    pub frame: Option<f32>,
    /// How far the exact voxelization is.
    pub exact: Option<f32>,
    /// How far the path tracer is.
    pub paths: Option<f32>,
    pub adapter: &'a str,
}

/// Which side panels are unfolded.
pub struct Unfolded {
    pub controls: bool,
    pub tree: bool,
    pub measurements: bool,
}

pub fn ui(ui: &mut Ui, bar: &TopBar<'_>, unfolded: &mut Unfolded) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal_centered(|ui| {
        let tip = "Shows or hides the controls on the left.";
        ui.toggle_value(&mut unfolded.controls, "Controls").on_hover_text(tip);
        let tip = "Shows or hides the scene tree: what the file holds, node by node (T).";
        ui.toggle_value(&mut unfolded.tree, "Tree").on_hover_text(tip);
        ui.separator();
        ui.label(RichText::new("Octolume").color(theme::ACCENT).heading());
        ui.label(RichText::new(bar.scene.unwrap_or("no scene")).color(theme::STRONG).heading());
        ui.add_space(8.0);
        commands.extend(status_ui(ui, bar));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = "Shows or hides the measurements on the right.";
            ui.toggle_value(&mut unfolded.measurements, "Measurements").on_hover_text(tip);
            ui.separator();
            let save = ui.add_enabled(bar.scene.is_some(), egui::Button::new("Screenshot"));
            let tip = "Saves the view as PNG with its settings inside (Ctrl+S).";
            if save.on_hover_text(tip).clicked() {
                commands.push(Command::SaveScreenshot);
            }
            // From the right: redo comes first.
            for (name, tip, command) in [
                ("Redo", "Sets again what was undone (Ctrl+Shift+Z).", Command::Redo),
                ("Undo", "Takes back the last change of anything but the time (Ctrl+Z).", Command::Undo),
            ] {
                if ui.button(name).on_hover_text(tip).clicked() {
                    commands.push(command);
                }
            }
            ui.separator();
            let adapter = egui::Label::new(RichText::new(bar.adapter).color(theme::WEAK)).truncate();
            ui.add(adapter).on_hover_text("The GPU everything runs on.");
        });
    });
    commands
}

fn status_ui(ui: &mut Ui, bar: &TopBar<'_>) -> Option<Command> {
    let mut cancelled = false;
    if let Some((title, fraction)) = bar.loading {
        ui.label(title);
        ui.add(ProgressBar::new(fraction).desired_width(110.0).show_percentage());
        cancelled = ui.button("Cancel").on_hover_text("Keeps the scene that is open.").clicked();
    } else if let Some(fraction) = bar.frame {
        ui.label(RichText::new("building").color(theme::ACCENT));
        ui.add(ProgressBar::new(fraction).desired_width(80.0).desired_height(6.0));
    } else if let Some(fraction) = bar.exact {
        ui.label(RichText::new("exact voxels").color(theme::ACCENT));
        ui.add(ProgressBar::new(fraction).desired_width(80.0).desired_height(6.0));
    } else if let Some(fraction) = bar.paths {
        ui.label(RichText::new("tracing paths").color(theme::ACCENT));
        ui.add(ProgressBar::new(fraction).desired_width(80.0).desired_height(6.0));
    } else {
        ui.label(RichText::new("ready").color(theme::WEAK));
    }
    cancelled.then_some(Command::CancelLoading)
}
