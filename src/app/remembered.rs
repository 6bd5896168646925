//! What the window remembers from one start to the next: side panels, where screenshots go, scenes that were open. Its
//! place on the screen and what is folded in a panel are remembered beside it, by eframe and egui.

use std::path::PathBuf;

use eframe::Storage;
use serde::{Deserialize, Serialize};

use super::App;
use super::host::{EGUI_KEY, Host};
use super::journal::Severity;

/// Goes up where something is renamed, moved or means something else; what is added has a default.
const FORMAT: u32 = 1;
/// Where the storage holds it; egui's memory is beside it.
const KEY: &str = eframe::APP_KEY;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    format: u32,
    /// Side panels that are unfolded.
    pub controls: bool,
    pub tree: bool,
    pub measurements: bool,
    /// Where screenshots go, as typed; `None`: where they go at first.
    pub screenshots: Option<String>,
    /// Scenes opened, newest first.
    pub recent: Vec<String>,
}

impl Default for Remembered {
    fn default() -> Self {
        Self { format: FORMAT, controls: true, tree: false, measurements: true, screenshots: None, recent: Vec::new() }
    }
}

impl Remembered {
    /// What a storage holds of it, or why that does not count.
    fn read(stored: Option<String>) -> Result<Option<Self>, String> {
        let Some(text) = stored else { return Ok(None) };
        let read: Self = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        match read.format {
            FORMAT => Ok(Some(read)),
            other => Err(format!("it has format {other}, and this Octolume reads format {FORMAT}")),
        }
    }
}

/// Why egui's own memory does not count, where there is some.
fn check_egui(storage: &dyn Storage) -> Result<(), String> {
    let is_whole = storage.get_string(EGUI_KEY).is_none() || {
        let read: Option<egui::Memory> = eframe::get_value(storage, EGUI_KEY);
        read.is_some()
    };
    if is_whole { Ok(()) } else { Err("what was folded is not readable".to_owned()) }
}

/// A file that holds something of which nothing was understood.
fn check_file(host: &Host) -> Result<(), String> {
    let size = host.remembered_in.as_ref().and_then(|file| file.metadata().ok()).map_or(0, |file| file.len());
    if size == 0 { Ok(()) } else { Err("nothing in it is readable".to_owned()) }
}

impl App {
    /// Takes up where the last window ended.
    pub(super) fn remember(&mut self, storage: Option<&dyn Storage>) {
        let Some(storage) = storage else { return };
        let read = Remembered::read(storage.get_string(KEY)).and_then(|read| {
            check_egui(storage)?;
            if read.is_none() {
                check_file(&self.host)?;
            }
            Ok(read)
        });
        match read {
            Ok(Some(remembered)) => self.take_up(remembered),
            Ok(None) => {}
            Err(cause) => {
                let file = self.host.remembered_in.as_ref().map_or("the storage".into(), |file| file.to_string_lossy());
                let sentence = format!("{file}: {cause}; the window opens as it did at first");
                self.journal.note(Severity::Warning, sentence);
            }
        }
    }

    fn take_up(&mut self, remembered: Remembered) {
        let unfolded = &mut self.desk.unfolded;
        (unfolded.controls, unfolded.tree) = (remembered.controls, remembered.tree);
        unfolded.measurements = remembered.measurements;
        if let Some(folder) = remembered.screenshots {
            self.screenshots.folder = folder;
        }
        remembered.recent.into_iter().rev().for_each(|scene| self.desk.remember(PathBuf::from(scene)));
    }

    /// Writes down what the next window takes up.
    pub(super) fn write_down(&self, storage: &mut dyn Storage) {
        let unfolded = &self.desk.unfolded;
        let folder = self.screenshots.folder.trim().to_owned();
        let is_usual = folder == self.host.screenshots.to_string_lossy();
        let remembered = Remembered {
            format: FORMAT,
            controls: unfolded.controls,
            tree: unfolded.tree,
            measurements: unfolded.measurements,
            screenshots: (!is_usual).then_some(folder),
            // What is not Unicode cannot be typed into the path field either.
            recent: self.desk.recent.iter().filter_map(|path| path.to_str()).map(str::to_owned).collect(),
        };
        if let Ok(text) = serde_json::to_string(&remembered) {
            storage.set_string(KEY, text);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Option<Remembered>, String> {
        Remembered::read(Some(text.to_owned()))
    }

    #[test]
    fn what_is_missing_is_as_at_first_and_what_is_more_does_no_harm() {
        let expected = Remembered { tree: true, ..Remembered::default() };
        assert_eq!(read(r#"{ "format": 1, "tree": true, "lamp": 7 }"#), Ok(Some(expected)));
        assert_eq!(Remembered::read(None), Ok(None));
    }

    #[test]
    fn what_is_broken_or_of_another_format_is_refused() {
        for text in ["", "(tree:true)", "{ \"tree\": 3 }", "null"] {
            assert!(read(text).is_err(), "{text}");
        }
        assert!(read(r#"{ "format": 2 }"#).is_err_and(|cause| cause.contains("format 2")));
    }
}
