//! A frame of the window: panels, the picture in the room that is left, and what the panels hold.

use std::time::Instant;

use egui::Ui;

use super::command::Command;
use super::panels::cones::ConesPanel;
use super::panels::discretization::DiscretizationPanel;
use super::panels::light::LightPanel;
use super::panels::path_field::path_field;
use super::panels::reference::ReferencePanel;
use super::panels::tree_row::TreePanel;
use super::panels::view::{CameraChoice, ViewPanel};
use super::panels::{self, section, section_revealed};
use super::{App, help, shortcuts, theme};
use crate::lights::Shines;
use crate::settings::{ConeTracing, View};

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let started = Instant::now();
        let ctx = ui.ctx().clone();
        if self.close_if_lost(&ctx) {
            return;
        }
        let clock_secs = ui.input(|input| input.time);
        self.latency.frame(ui);
        self.collect(&ctx);
        let mut commands = shortcuts::commands(ui);
        commands.extend(self.desk.opened(&ctx));
        commands.extend(self.panels_ui(ui));
        self.apply_all(&ctx, commands, clock_secs);
        if let Some(time_secs) = self.playback.advance(clock_secs, self.clip_secs()) {
            self.settings.shot.motion.time_secs = time_secs;
        }
        let picture = egui::CentralPanel::no_frame().show(ui, |ui| self.picture_ui(ui, clock_secs)).response.rect;
        help::ui(&ctx, &mut self.is_help_open);
        self.note_for_undo(clock_secs);
        if self.journal.toasts_ui(&ctx, picture) {
            self.show_log(&ctx);
        }
        if self.wake_again(&ctx, clock_secs) {
            self.latency.continues(started);
        }
        // Lost on the way: what was painted must not be uploaded.
        self.close_if_lost(&ctx);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if self.host.remembered_in.is_some() {
            self.write_down(storage);
        }
    }

    fn persist_egui_memory(&self) -> bool {
        self.host.remembered_in.is_some()
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        theme::BACKGROUND.to_normalized_gamma_f32()
    }
}

impl App {
    fn apply_all(&mut self, ctx: &egui::Context, commands: Vec<Command>, clock_secs: f64) {
        commands.into_iter().for_each(|command| self.apply(ctx, command, clock_secs));
    }

    pub(super) fn tree_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let Some(ready) = &self.scene else {
            panels::nothing(ui, "No scene is open.");
            return Vec::new();
        };
        let panel = TreePanel {
            prepared: &ready.prepared,
            outline: &ready.outline,
            visibility: &self.settings.shot.visibility,
        };
        panels::tree::ui(ui, panel, &mut self.desk.tree)
    }

    pub(super) fn controls_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let settings = &self.settings;
        let grid = self.scene.as_ref().map(|ready| &ready.prepared.grid);
        let asks_for_path = self.desk.revealed == Some(panels::SCENE);
        let mut commands = section_revealed(ui, panels::SCENE, true, &mut self.desk.revealed, |ui| {
            let scene = self.scene.as_ref().map(|ready| &*ready.prepared);
            panels::scene::ui(ui, scene, (&mut self.desk.path, asks_for_path), &self.desk.recent)
        });
        commands.extend(section(ui, "Discretization", true, |ui| {
            panels::discretization::ui(
                ui,
                DiscretizationPanel {
                    discretization: &settings.method.discretization,
                    shot: &settings.shot,
                    span: grid.map(|grid| grid.span),
                    selected: self.desk.tree.selected,
                },
            )
        }));
        commands
            .extend(section(ui, "Filter", true, |ui| panels::filter::ui(ui, settings, self.stage.accuracy.as_ref())));
        commands.extend(section(ui, "Light", false, |ui| self.light_ui(ui)));
        commands.extend(section(ui, "View", true, |ui| self.view_ui(ui)));
        commands.extend(section(ui, "Cone tracing", false, |ui| self.cones_ui(ui)));
        commands
    }

    fn view_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let settings = &self.settings;
        let prepared = self.prepared();
        let panel = ViewPanel {
            look: &settings.method.look,
            depth: prepared.map_or(settings.method.discretization.depth(), |prepared| prepared.grid.depth),
            camera: match (&settings.shot.camera, &settings.shot.file_camera) {
                (Some(_), _) => CameraChoice::Free,
                (None, Some(name)) => CameraChoice::OfFile(name),
                (None, None) => CameraChoice::Framed,
            },
            seen: self.camera(self.view_px),
            cameras: prepared.map_or(&[][..], |prepared| &prepared.scene.cameras),
            lights: &self.shining(),
            exposure: self.stage.exposure,
        };
        let mut commands = panels::view::ui(ui, panel);
        panels::control(ui, "Save to", "Folder that screenshots are written to.", |ui| {
            path_field(ui, "screenshots folder", &mut self.screenshots.folder, ui.available_width())
        });
        if settings.method.look.view == View::Surfaces {
            let tip = "Saves what is shown as OpenEXR: linear, unclamped, in nits, lux or scene units.";
            if ui.button("Save light").on_hover_text(tip).clicked() {
                commands.push(Command::SaveLight);
            }
        }
        commands
    }

    fn cones_ui(&self, ui: &mut Ui) -> Vec<Command> {
        let settings = &self.settings;
        let extent = self.prepared().map_or(0.0, |prepared| f64::from(prepared.grid.cells()) * prepared.grid.span);
        let panel = ConesPanel {
            cones: &settings.method.cone_tracing,
            look: &settings.method.look,
            occlusion_distance: extent * ConeTracing::OCCLUSION_GRID_PART,
        };
        panels::cones::ui(ui, panel)
    }

    /// Names of the lights that have a shadow map, as far as they are asked for.
    pub(super) fn shining(&self) -> Vec<String> {
        let looked_at = self.settings.method.look.view == View::ShadowMap;
        let known = self.prepared().filter(|_| looked_at).map(|prepared| prepared.known_lights(&self.settings));
        let known = known.and_then(Result::ok).unwrap_or_default();
        known.into_iter().filter(|light| light.shines == Shines::Yes).map(|light| light.name).collect()
    }

    fn light_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let Some(ready) = &self.scene else {
            panels::nothing(ui, "No scene is open.");
            return Vec::new();
        };
        let lighting = &self.settings.method.lighting;
        let known = match ready.prepared.known_lights(&self.settings) {
            Ok(known) => known,
            Err(error) => {
                panels::nothing(ui, &error.to_string());
                return Vec::new();
            }
        };
        let camera = self.camera(self.view_px);
        let panel = LightPanel { lighting, scene: &ready.prepared.scene, known: &known, camera };
        panels::light::ui(ui, panel, &mut self.desk.light)
    }

    pub(super) fn measurements_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let stage = &self.stage;
        let mut commands = section(ui, "Timings", true, |ui| {
            panels::timings::ui(ui, (&stage.timings, stage.last_frame), &stage.history, &self.latency);
            Vec::new()
        });
        let inspector = &mut self.desk.inspector;
        inspector.is_open = false;
        commands.extend(section(ui, "Node under cursor", false, |ui| {
            inspector.is_open = true;
            panels::node::ui(ui, inspector, &self.settings.method.look)
        }));
        let reference = &mut self.desk.reference;
        reference.is_open = false;
        commands.extend(section(ui, "Reference", false, |ui| {
            reference.is_open = true;
            let panel = ReferencePanel {
                reference,
                timings: &stage.timings,
                is_surfaces: self.settings.method.look.view == View::Surfaces,
                has_scene: self.scene.is_some(),
            };
            panels::reference::ui(ui, &panel)
        }));
        commands.extend(section(ui, "Measure", false, |ui| {
            panels::measure::ui(ui, &self.desk.measuring, self.scene.is_some())
        }));
        commands.extend(section(ui, "Octree", true, |ui| {
            panels::octree::ui(ui, stage.octree.as_ref(), self.settings.method.look.level);
            Vec::new()
        }));
        commands.extend(section(ui, "Frame plan", true, |ui| {
            panels::plan::ui(ui, &stage.plan);
            Vec::new()
        }));
        commands.extend(section(ui, "Memory", false, |ui| {
            panels::memory::ui(ui, &stage.engine.memory());
            Vec::new()
        }));
        let log = |ui: &mut Ui| panels::log::ui(ui, self.journal.entries());
        commands.extend(section_revealed(ui, panels::LOG, false, &mut self.desk.revealed, log));
        commands
    }
}
