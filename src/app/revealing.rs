//! What the window unfolds and scrolls to by itself.

use super::journal::Severity;
use super::{App, panels};

impl App {
    /// Where the desktop has no file dialog.
    pub(super) fn ask_for_path(&mut self, ctx: &egui::Context) {
        let sentence = "There is no file dialog here: type a path and press Enter, or drop a file on the window.";
        self.journal.tell(Severity::Warning, sentence);
        self.desk.unfolded.controls = true;
        self.reveal(ctx, panels::SCENE);
    }

    pub(super) fn show_log(&mut self, ctx: &egui::Context) {
        self.desk.unfolded.measurements = true;
        self.reveal(ctx, panels::LOG);
    }

    /// The panels of this frame are laid out already.
    fn reveal(&mut self, ctx: &egui::Context, section: &'static str) {
        self.desk.revealed = Some(section);
        ctx.request_repaint();
    }
}
