//! What the person has lying about: typed paths, unfolded panels, a file dialog that is open.

use std::path::PathBuf;

use super::background::{Background, Outcome};
use super::command::Command;
use super::inspector::Inspector;
use super::measuring::Measuring;
use super::panels::top_bar::Unfolded;
use super::panels::tree::TreeState;
use super::reference::Reference;
use crate::lights::LightSource;

pub struct Desk {
    /// The path field, as typed.
    pub path: String,
    /// Scenes opened, newest first.
    pub recent: Vec<PathBuf>,
    pub unfolded: Unfolded,
    pub tree: TreeState,
    /// The light whose controls are shown.
    pub light: Option<LightSource>,
    pub inspector: Inspector,
    pub reference: Reference,
    pub measuring: Measuring,
    dialog: Option<Background<Option<PathBuf>>>,
}

impl Default for Desk {
    fn default() -> Self {
        Self {
            path: String::new(),
            recent: Vec::new(),
            unfolded: Unfolded { controls: true, tree: false, measurements: true },
            tree: TreeState::default(),
            light: None,
            inspector: Inspector::default(),
            reference: Reference::default(),
            measuring: Measuring::default(),
            dialog: None,
        }
    }
}

impl Desk {
    /// Something is traced, compared or measured.
    pub fn is_busy(&self) -> bool {
        self.reference.is_busy() || self.measuring.is_busy()
    }

    /// Opens the desktop's dialog, on a thread of its own because some never answer. One at a time.
    pub fn choose_file(&mut self, ctx: &egui::Context) {
        if self.dialog.is_none() {
            let dialog = rfd::AsyncFileDialog::new().set_title("Open a scene, or a picture of one");
            let dialog = dialog.add_filter("glTF, pictures", &["gltf", "glb", "png", "json"]);
            let chosen = dialog.pick_file();
            self.dialog =
                Some(Background::start(ctx, move |_| pollster::block_on(chosen).map(|file| file.path().to_owned())));
        }
    }

    /// What the dialog has chosen, and what was dropped on the window.
    pub fn opened(&mut self, ctx: &egui::Context) -> Option<Command> {
        let dropped = ctx.input(|input| input.raw.dropped_files.last().map(|file| file.path().to_owned()));
        let chosen = match self.dialog.as_ref().map(Background::poll) {
            Some(Outcome::Done(chosen)) => {
                self.dialog = None;
                chosen
            }
            Some(Outcome::Died) => {
                self.dialog = None;
                None
            }
            Some(Outcome::Running) | None => None,
        };
        dropped.or(chosen).map(Command::Open)
    }

    /// Puts a scene first among the recent ones.
    pub fn remember(&mut self, path: PathBuf) {
        const LENGTH: usize = 10;
        self.recent.retain(|old| *old != path);
        self.recent.insert(0, path);
        self.recent.truncate(LENGTH);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_scenes_are_listed_once_newest_first() {
        let mut desk = Desk::default();
        ["a", "b", "a"].into_iter().for_each(|name| desk.remember(PathBuf::from(name)));
        assert_eq!(desk.recent, [PathBuf::from("a"), PathBuf::from("b")]);
        (0..20).for_each(|number| desk.remember(PathBuf::from(number.to_string())));
        assert_eq!(desk.recent.len(), 10);
    }
}
