//! How scenes come and go: what opening one keeps of the last, and what becomes of a failure.

use std::path::PathBuf;

use super::inspector::Pin;
use super::journal::Severity;
use super::loader::Ready;
use super::panels::tree::TreeState;
use super::restored::holds_settings;
use super::undo::Undo;
use super::{App, panels};
use crate::prepare::{Preparation, Prepared};
use crate::scene::Scene;
use crate::scene::load::SceneChoice;
use crate::settings::{Fit, MotionSettings, NodeNames, Visibility};

impl App {
    /// A scene, or a picture that tells of one. `shown`: which of several scenes in the file.
    pub(super) fn open(&mut self, ctx: &egui::Context, path: PathBuf, shown: Option<SceneChoice>) {
        if holds_settings(&path) {
            return self.restore(ctx, &path);
        }
        // A span, a pose and a camera of one scene mean nothing in another.
        if self.scene.is_some() {
            self.settings.method.discretization.span = None;
            self.settings.shot.fit = Fit::default();
        }
        self.loader.open(ctx, &path, shown, Preparation::from(&self.settings));
        self.desk.path = path.display().to_string();
    }

    /// Opens the file again, at another of its scenes.
    pub(super) fn show_another_scene(&mut self, ctx: &egui::Context, number: usize) {
        let source = self.prepared().and_then(|prepared| prepared.scene.source.clone());
        if let Some(source) = source {
            self.open(ctx, source, Some(SceneChoice::Number(number)));
        }
    }

    pub(super) fn cancel_loading(&mut self) {
        self.loader.cancel();
        self.keep_open_scene();
        self.journal.note(Severity::Info, "Cancelled.");
    }

    /// What could not be made is not asked for again.
    fn keep_open_scene(&mut self) {
        if let Some(ready) = &self.scene {
            ready.preparation.keep_in(&mut self.settings);
            // Another clip, or another moment of a grid that fits the pose.
            if !ready.preparation.same_voxels(&Preparation::from(&self.settings)) {
                self.settings.shot.motion.clone_from(&ready.preparation.motion);
                self.playback.pause();
            }
        }
    }

    /// Takes over what threads have finished.
    pub(super) fn collect(&mut self, ctx: &egui::Context) {
        match self.loader.poll() {
            Some(Ok(ready)) => self.show_scene(ctx, ready),
            Some(Err(cause)) => {
                self.names = NodeNames::default();
                self.keep_open_scene();
                self.journal.tell(Severity::Error, cause);
            }
            None => {}
        }
        for written in self.screenshots.poll() {
            match written {
                Ok(file) => self.journal.tell_saved(file),
                Err(cause) => self.journal.tell(Severity::Error, cause),
            }
        }
        let wanted = Preparation::from(&self.settings);
        match &self.scene {
            Some(ready) if self.loader.is_opening() || ready.preparation.same_voxels(&wanted) => {}
            Some(ready) => self.loader.discretize(ctx, &ready.prepared, wanted),
            None => {}
        }
    }

    fn show_scene(&mut self, ctx: &egui::Context, ready: Ready) {
        let prepared = &ready.prepared;
        if ready.is_new {
            if self.scene.is_some() {
                self.settings.shot.motion = MotionSettings::default();
                (self.settings.shot.camera, self.settings.shot.file_camera) = (None, None);
                self.settings.shot.visibility = Visibility::default();
                // Places and nodes of the scene before mean nothing here.
                self.settings.method.lighting.edits.clear();
                self.settings.method.lighting.added.clear();
                self.settings.method.look.shadow_map = 0;
                self.playback.pause();
            }
            self.find_named(&prepared.scene);
            self.desk.tree = TreeState::default();
            self.desk.light = None;
            self.desk.inspector.apply(Pin::Release);
            self.undo = Undo::default();
            self.name_window(ctx, prepared);
            let name = &prepared.scene.name;
            let count = panels::grouped(prepared.voxel_count());
            self.journal.note(
                Severity::Info,
                format!("Opened {name}: {count} voxels in {:.0} ms; {}.", prepared.voxelize_ms, prepared.origins),
            );
            for warning in &prepared.warnings {
                self.journal.note(Severity::Warning, &warning.sentence);
            }
        }
        self.stage.set_prepared(prepared);
        let is_new = ready.is_new;
        self.scene = Some(ready);
        if is_new {
            self.finish_restoring();
        }
        let shot = &self.settings.shot;
        let opens_with_its_camera = is_new && shot.camera.is_none() && shot.file_camera.is_none();
        if opens_with_its_camera {
            self.look_through(0);
        }
    }

    /// Looks up what the command line and the settings say of nodes by name or number; what the scene does
    /// not have hides and changes nothing.
    fn find_named(&mut self, scene: &Scene) {
        let names = std::mem::take(&mut self.names);
        let visibility = &mut self.settings.shot.visibility;
        let applied = names.apply(scene, visibility);
        let hidden = applied.and_then(|notes| visibility.shown_nodes(scene).map(|_| notes));
        let hidden = hidden.map_err(|error| {
            *visibility = Visibility::default();
            error.to_string()
        });
        if names.choose_nodes() {
            self.settings.shot.fit.counted.clone_from(&self.settings.shot.visibility);
        }
        let lighting = &mut self.settings.method.lighting;
        let lit = names.change_lights(scene, lighting).map_err(|error| {
            lighting.edits.clear();
            error.to_string()
        });
        for found in [hidden, lit] {
            match found {
                Ok(notes) => notes.into_iter().for_each(|note| self.journal.note(Severity::Warning, note)),
                Err(error) => self.journal.tell(Severity::Error, error),
            }
        }
    }

    pub(super) fn name_window(&mut self, ctx: &egui::Context, prepared: &Prepared) {
        let name = &prepared.scene.name;
        ctx.send_viewport_cmd(egui::ViewportCommand::Title(format!("Octolume — {name}")));
        let source = prepared.scene.source.clone();
        self.desk.path = source.as_ref().map_or_else(|| name.clone(), |source| source.display().to_string());
        // The next window may be opened in another folder.
        let source = source.map(|source| std::path::absolute(&source).unwrap_or(source));
        self.desk.remember(source.unwrap_or_else(|| PathBuf::from(name)));
    }

    /// Takes a camera of the file, if it has this one.
    pub(super) fn look_through(&mut self, camera: usize) {
        let cameras = self.prepared().map_or(&[][..], |prepared| &prepared.scene.cameras);
        if let Some(name) = cameras.get(camera).map(|camera| camera.name.clone()) {
            (self.settings.shot.camera, self.settings.shot.file_camera) = (None, Some(name));
        }
    }
}
