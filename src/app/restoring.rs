//! A picture that the program saved, or its settings, opened like a scene: scene, moment, camera and everything that
//! was set come back.

use std::path::Path;

use super::App;
use super::journal::Severity;
use super::loader::file_name;
use super::restored::{Restored, fitted, scene_of};
use crate::export;
use crate::prepare::Preparation;

impl App {
    /// Reads settings and opens their scene; where that is gone, whatever scene is opened next gets them.
    pub(super) fn restore(&mut self, ctx: &egui::Context, path: &Path) {
        let settings = match export::read_settings(path) {
            Ok(settings) => settings,
            Err(error) => return self.journal.tell(Severity::Error, error.to_string()),
        };
        let picture = file_name(path);
        let Some(identity) = settings.shot.scene.clone() else {
            let sentence =
                format!("{picture} does not tell of which scene it is: the next scene opened gets its settings.");
            self.restored = Some(Restored { picture, settings });
            return self.journal.tell(Severity::Warning, sentence);
        };
        let is_open = self.prepared().is_some_and(|prepared| prepared.scene.identity() == identity);
        let restored = Restored { picture, settings };
        match scene_of(path, &identity) {
            _ if is_open => self.take_over(restored),
            Some(scene) => {
                let preparation = Preparation::from(&restored.settings);
                self.loader.open(ctx, &scene, None, preparation);
                self.desk.path = scene.display().to_string();
                self.restored = Some(restored);
            }
            None => {
                let sentence = format!(
                    "{} is a picture of {}, which is not there: the next scene opened gets its settings.",
                    restored.picture, identity.source
                );
                self.restored = Some(restored);
                self.journal.tell(Severity::Warning, sentence);
            }
        }
    }

    /// Settings that waited for their scene: it is open now.
    pub(super) fn finish_restoring(&mut self) {
        if let Some(restored) = self.restored.take() {
            self.take_over(restored);
        }
    }

    fn take_over(&mut self, Restored { picture, mut settings }: Restored) {
        let Some(scene) = self.prepared().map(|prepared| prepared.scene.clone()) else { return };
        let notes = fitted(&mut settings, &scene);
        self.settings = settings;
        self.playback.pause();
        self.journal.tell(Severity::Info, format!("Everything is as in {picture}."));
        notes.into_iter().for_each(|note| self.journal.tell(Severity::Warning, format!("{picture}: {note}")));
    }
}
