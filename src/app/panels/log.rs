//! What happened, newest first.

use egui::{RichText, Ui};

use super::nothing;
use crate::app::command::Command;
use crate::app::journal::Entry;
use crate::app::palette::Tone;

pub fn ui<'a>(ui: &mut Ui, entries: impl DoubleEndedIterator<Item = &'a Entry>) -> Vec<Command> {
    let mut entries = entries.rev().peekable();
    if entries.peek().is_none() {
        nothing(ui, "Nothing yet.");
        return Vec::new();
    }
    let mut commands = Vec::new();
    if ui.small_button("Clear log").on_hover_text("Forgets all lines.").clicked() {
        commands.push(Command::ClearLog);
    }
    for entry in entries {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(clock(entry.at_secs)).color(Tone::Weak.of(ui)).monospace());
            ui.label(RichText::new(&entry.text).color(entry.severity.tone().of(ui)));
            let file = entry.file.as_ref().map(|file| file.display().to_string());
            if let Some(file) = file.filter(|_| ui.small_button("Copy path").clicked()) {
                commands.push(Command::Copy(file));
            }
        });
    }
    commands
}

/// Minutes and seconds since the window opened.
fn clock(secs: f64) -> String {
    format!("{:02}:{:04.1}", (secs / 60.0) as u64, secs % 60.0)
}
