//! Messages to the person: a short-lived note over the picture, and a line in the log that stays.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::Instant;

use egui::{Context, Rect};

use super::palette::Tone;
use super::toasts::Toasts;

/// Lines kept.
const LENGTH: usize = 500;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    Info,
    Warning,
    Error,
}

impl Severity {
    /// Of its note, and of its line in the log.
    pub fn tone(self) -> Tone {
        match self {
            Self::Info => Tone::Strong,
            Self::Warning => Tone::Warning,
            Self::Error => Tone::Error,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Since the window opened.
    pub at_secs: f64,
    pub severity: Severity,
    pub text: String,
    /// What it tells of, where that is a file.
    pub file: Option<PathBuf>,
}

pub struct Journal {
    opened: Instant,
    entries: VecDeque<Entry>,
    toasts: Toasts,
    /// Hears errors too.
    tell_error: fn(&str),
}

impl Journal {
    pub fn new(tell_error: fn(&str)) -> Self {
        Self { opened: Instant::now(), entries: VecDeque::new(), toasts: Toasts::default(), tell_error }
    }

    /// A line in the log alone.
    pub fn note(&mut self, severity: Severity, text: impl Into<String>) {
        if self.entries.len() == LENGTH {
            self.entries.pop_front();
        }
        let at_secs = self.opened.elapsed().as_secs_f64();
        self.entries.push_back(Entry { at_secs, severity, text: text.into(), file: None });
    }

    /// A line in the log, and a note over the picture for a few seconds.
    pub fn tell(&mut self, severity: Severity, text: impl Into<String>) {
        let text = text.into();
        if severity == Severity::Error {
            (self.tell_error)(&text);
        }
        let secs = if severity == Severity::Info { 3.0 } else { 8.0 };
        self.toasts.add(&text, severity.tone(), secs);
        self.note(severity, text);
    }

    /// The same of a file that was written.
    pub fn tell_saved(&mut self, file: PathBuf) {
        self.tell(Severity::Info, format!("Saved {}", file.display()));
        if let Some(entry) = self.entries.back_mut() {
            entry.file = Some(file);
        }
    }

    pub fn entries(&self) -> impl DoubleEndedIterator<Item = &Entry> {
        self.entries.iter()
    }

    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// Notes over the picture's area; whether one was clicked.
    pub fn toasts_ui(&mut self, ctx: &Context, picture: Rect) -> bool {
        self.toasts.ui(ctx, picture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_log_forgets_its_oldest_lines() {
        let mut journal = Journal::new(|_| {});
        (0..LENGTH + 5).for_each(|line| journal.note(Severity::Info, line.to_string()));
        assert_eq!(journal.entries().next().map(|entry| entry.text.as_str()), Some("5"));
    }
}
