//! What the person has lying about: typed paths, unfolded panels, a file dialog that is open.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::background::{Background, Outcome};
use super::command::Command;
use super::host::Choice;
use super::inspector::Inspector;
use super::measuring::Measuring;
use super::panels::top_bar::Unfolded;
use super::panels::tree::TreeState;
use super::reference::Reference;
use crate::lights::LightSource;

/// No person has seen a dialog that ends sooner: there was none.
const UNSEEN: Duration = Duration::from_millis(500);

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
    /// The section that is to be unfolded and scrolled to, by its title.
    pub revealed: Option<&'static str>,
    dialog: Option<Background<Answer>>,
}

/// What a file dialog ends with.
enum Answer {
    File(PathBuf),
    Nothing,
    NoDialog,
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
            revealed: None,
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
    pub fn choose_file(&mut self, ctx: &egui::Context, choose: fn() -> Choice) {
        if self.dialog.is_none() {
            let choice = choose();
            self.dialog = Some(Background::start(ctx, move |_| {
                let opened = Instant::now();
                match pollster::block_on(choice) {
                    Some(file) => Answer::File(file),
                    None if opened.elapsed() < UNSEEN => Answer::NoDialog,
                    None => Answer::Nothing,
                }
            }));
        }
    }

    /// What the dialog has chosen, and what was dropped on the window.
    pub fn opened(&mut self, ctx: &egui::Context) -> Option<Command> {
        let dropped = ctx.input(|input| input.raw.dropped_files.last().map(|file| file.path().to_owned()));
        let answer = match self.dialog.as_ref().map(Background::poll) {
            Some(Outcome::Running) | None => None,
            Some(Outcome::Done(answer)) => Some(answer),
            Some(Outcome::Died) => Some(Answer::NoDialog),
        };
        if answer.is_some() {
            self.dialog = None;
        }
        match (dropped, answer) {
            (Some(file), _) | (None, Some(Answer::File(file))) => Some(Command::Open(file)),
            (None, Some(Answer::NoDialog)) => Some(Command::AskForPath),
            (None, Some(Answer::Nothing) | None) => None,
        }
    }

    pub fn has_dialog(&self) -> bool {
        self.dialog.is_some()
    }

    /// Puts a scene first among the recent ones.
    pub fn remember(&mut self, path: PathBuf) {
        const LENGTH: usize = 10;
        self.recent.retain(|old| *old != path);
        self.recent.insert(0, path);
        self.recent.truncate(LENGTH);
    }

    /// Takes a scene out of the recent ones.
    pub fn forget(&mut self, path: &Path) {
        self.recent.retain(|old| old != path);
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
        desk.forget(Path::new("a"));
        assert_eq!(desk.recent, [PathBuf::from("b")]);
        (0..20).for_each(|number| desk.remember(PathBuf::from(number.to_string())));
        assert_eq!(desk.recent.len(), 10);
    }
}
