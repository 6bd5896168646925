//! The list of all keys and gestures, in a window of its own.

use egui::{Align2, Grid, RichText, ScrollArea, Ui, vec2};

use super::palette::Tone;
use super::{gestures, shortcuts};

const SIZE: egui::Vec2 = vec2(520.0, 420.0);
/// Around it, in a window that is smaller.
const MARGIN: f32 = 60.0;

/// `is_open`: unset by its button and by Escape.
pub fn ui(ctx: &egui::Context, is_open: &mut bool) {
    if *is_open && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape)) {
        *is_open = false;
    }
    let size = SIZE.min(ctx.content_rect().size() - vec2(MARGIN, MARGIN)).max(vec2(MARGIN, MARGIN));
    let window = egui::Window::new("Keys and mouse").id(egui::Id::unique("help")).open(is_open).collapsible(false);
    window.anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0)).fixed_size(size).show(ctx, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let keys = shortcuts::SHORTCUTS.iter().map(|shortcut| (shortcut.name(ui.ctx()), shortcut.does));
            let keys: Vec<_> = keys.collect();
            list_ui(ui, "Keys", keys.iter().map(|(name, does)| (name.as_str(), *does)));
            ui.add_space(8.0);
            list_ui(ui, "Mouse", gestures::all());
        });
    });
}

fn list_ui<'a>(ui: &mut Ui, title: &str, rows: impl Iterator<Item = (&'a str, &'a str)>) {
    ui.label(RichText::new(title).color(Tone::Strong.of(ui)).heading());
    Grid::new(title).num_columns(2).spacing([14.0, 4.0]).show(ui, |ui| {
        for (name, does) in rows {
            ui.label(RichText::new(name).color(Tone::Strong.of(ui)));
            ui.add(egui::Label::new(does).wrap());
            ui.end_row();
        }
    });
}
