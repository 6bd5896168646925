//! What follows the picture in every frame of the window: the path tracer, an experiment, the node under the pointer.

use std::sync::Arc;

use egui::Response;

use super::App;
use super::journal::Severity;
use super::measuring::ShownScene;
use super::reference::{Seen, ShownSurfaces};
use crate::gpu::GpuTexture;
use crate::settings::Settings;

impl App {
    /// The path tracer beside the picture: works on its own, and reads what is finished.
    pub(super) fn follow_reference(&mut self, ctx: &egui::Context, settings: &Settings, full_px: [u32; 2]) {
        let Some(ready) = &self.scene else { return };
        let stage = &self.stage;
        let is_full = stage.picture().map(GpuTexture::size_px) == Some(full_px) && !stage.engine.shows_nothing();
        let shown = ShownSurfaces {
            seen: Seen { prepared: Arc::clone(&ready.prepared), settings: settings.clone(), size_px: full_px },
            disk: self.loader.disk(),
            engine: &stage.engine,
            results: stage.results,
            is_finished: is_full && stage.working().is_none() && stage.error().is_none(),
            is_quiet: !self.latency.is_under_input(),
            is_still: !self.playback.is_playing(),
        };
        if let Err(error) = self.desk.reference.follow(ctx, &shown) {
            self.journal.tell(Severity::Error, error);
        }
    }

    /// Gives an experiment that is on its way its slice of a frame of the window.
    pub(super) fn follow_measuring(&mut self, ctx: &egui::Context, settings: &Settings) {
        let Some(ready) = &self.scene else { return };
        let (stage, prepared) = (&self.stage, &ready.prepared);
        // The picture first.
        let is_shared = stage.working().is_some() || self.latency.is_under_input();
        let budget = if is_shared { stage.pace.budget_under_input } else { stage.pace.budget };
        let shown = ShownScene { gpu: stage.engine.gpu(), prepared, settings, budget };
        let (sentences, outcome) = self.desk.measuring.follow(ctx, &shown);
        sentences.into_iter().for_each(|sentence| self.journal.note(Severity::Warning, sentence));
        if let Err(error) = outcome {
            self.journal.tell(Severity::Error, error);
        }
    }

    /// Reads the node that is looked at, where its panel is unfolded.
    pub(super) fn inspect(&mut self, ui: &egui::Ui, response: &Response) {
        let inspector = &mut self.desk.inspector;
        if !inspector.is_open {
            return;
        }
        if let Err(error) = inspector.follow(ui, response, &self.stage) {
            inspector.is_open = false;
            self.journal.tell(Severity::Error, error.to_string());
        }
    }
}
