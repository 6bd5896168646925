//! Where the panels are around the picture, and how wide.

use std::ops::RangeInclusive;

use egui::{Panel, ScrollArea, Ui};

use super::App;
use super::command::Command;
use super::folding::{CONTROLS_WIDTHS, MEASUREMENTS_WIDTHS, PICTURE_WIDTH, TREE_WIDTHS};
use super::panels;
use super::panels::top_bar::{TopBar, Unfolded};

/// All of the timeline has room in it.
const TIMELINE_WIDTH: f32 = 830.0;

impl App {
    /// From the outside in; the picture has the room that is left.
    pub(super) fn panels_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut shown = self.folding.shown(self.desk.unfolded, ui.available_width());
        Panel::top("top bar").exact_size(34.0).show(ui, |ui| commands.extend(self.top_bar_ui(ui, &mut shown)));
        Panel::bottom("timeline").exact_size(36.0).show(ui, |ui| commands.extend(self.timeline_ui(ui)));
        let after = |is_shown: bool, [least, _]: [f32; 2]| if is_shown { least } else { 0.0 };
        let right = after(shown.measurements, MEASUREMENTS_WIDTHS);
        let width = side_width(ui, CONTROLS_WIDTHS, right + after(shown.tree, TREE_WIDTHS));
        let panel = Panel::left("controls").default_size(292.0).size_range(width);
        panel.show_collapsible(ui, &mut shown.controls, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| commands.extend(self.controls_ui(ui)));
        });
        let width = side_width(ui, TREE_WIDTHS, right);
        let panel = Panel::left("tree").default_size(270.0).size_range(width);
        panel.show_collapsible(ui, &mut shown.tree, |ui| commands.extend(self.tree_ui(ui)));
        let width = side_width(ui, MEASUREMENTS_WIDTHS, 0.0);
        let panel = Panel::right("measurements").default_size(350.0).size_range(width);
        panel.show_collapsible(ui, &mut shown.measurements, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| commands.extend(self.measurements_ui(ui)));
        });
        self.folding.note(&mut self.desk.unfolded, shown);
        commands
    }

    fn top_bar_ui(&mut self, ui: &mut Ui, shown: &mut Unfolded) -> Vec<Command> {
        let bar = TopBar {
            scene: self.scene.as_ref().map(|ready| ready.prepared.scene.name.as_str()),
            loading: self.loader.progress(),
            frame: self.stage.working(),
            exact: self.exact.fraction(),
            paths: self.desk.reference.fraction(),
            adapter: &self.stage.engine.gpu().info.name,
        };
        panels::top_bar::ui(ui, &bar, shown)
    }

    fn timeline_ui(&self, ui: &mut Ui) -> Vec<Command> {
        let clips = self.prepared().map_or(&[][..], |prepared| &prepared.scene.clips);
        let shown_secs = self.stage.engine.moment_on_screen().map(|motion| motion.time_secs);
        // A narrower window scrolls it.
        let scrolled = ScrollArea::horizontal().show(ui, |ui| {
            ui.set_min_width(TIMELINE_WIDTH);
            panels::timeline::ui(ui, (clips, self.clip()), (&self.settings.shot.motion, shown_secs), &self.playback)
        });
        scrolled.inner
    }
}

/// How wide a side panel may be: the picture, and what comes after it, keep their room.
fn side_width(ui: &Ui, [least, most]: [f32; 2], after: f32) -> RangeInclusive<f32> {
    least..=most.min(ui.available_width() - after - PICTURE_WIDTH).max(least)
}
