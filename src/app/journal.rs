//! Messages to the person: a short-lived note in the corner, and a line in the log that stays.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use egui::Color32;
use egui_notify::{Anchor, Toast, ToastLevel, Toasts};

use super::theme;

/// Lines kept.
const LENGTH: usize = 500;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    Info,
    Warning,
    Error,
}

impl Severity {
    pub fn color(self) -> Color32 {
        match self {
            Self::Info => theme::STRONG,
            Self::Warning => theme::WARNING,
            Self::Error => theme::ERROR,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Since the window opened.
    pub at_secs: f64,
    pub severity: Severity,
    pub text: String,
}

pub struct Journal {
    opened: Instant,
    entries: VecDeque<Entry>,
    toasts: Toasts,
}

impl Default for Journal {
    fn default() -> Self {
        let toasts = Toasts::new().with_anchor(Anchor::BottomRight).with_margin(egui::vec2(12.0, 48.0));
        Self { opened: Instant::now(), entries: VecDeque::new(), toasts }
    }
}

impl Journal {
    /// A line in the log alone.
    pub fn note(&mut self, severity: Severity, text: impl Into<String>) {
        if self.entries.len() == LENGTH {
            self.entries.pop_front();
        }
        let at_secs = self.opened.elapsed().as_secs_f64();
        self.entries.push_back(Entry { at_secs, severity, text: text.into() });
    }

    /// A line in the log, and a note in the corner for a few seconds.
    pub fn tell(&mut self, severity: Severity, text: impl Into<String>) {
        let text = text.into();
        let secs = if severity == Severity::Info { 3 } else { 8 };
        let mut toast = Toast::basic(egui::RichText::new(wrapped(&text)).color(severity.color()));
        // Without a level there is no symbol, which the fonts may lack.
        toast.level(ToastLevel::None).closable(false).duration(Duration::from_secs(secs)).show_progress_bar(false);
        self.toasts.add(toast);
        self.note(severity, text);
    }

    pub fn entries(&self) -> impl DoubleEndedIterator<Item = &Entry> {
        self.entries.iter()
    }

    pub fn clear(&mut self) {
        self.entries.clear();
    }

    pub fn show_toasts(&mut self, ctx: &egui::Context) {
        self.toasts.show(ctx);
    }
}

/// Notes do not wrap by themselves.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 64;
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(word.to_owned());
        } else {
            if !lines[last].is_empty() {
                lines[last].push(' ');
            }
            lines[last].push_str(word);
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_sentences_are_broken_between_words() {
        let text = "word ".repeat(30);
        assert!(wrapped(&text).lines().all(|line| line.len() <= 64 && !line.ends_with(' ')));
        assert_eq!(wrapped("short one"), "short one");
    }

    #[test]
    fn the_log_forgets_its_oldest_lines() {
        let mut journal = Journal::default();
        (0..LENGTH + 5).for_each(|line| journal.note(Severity::Info, line.to_string()));
        assert_eq!(journal.entries().next().map(|entry| entry.text.as_str()), Some("5"));
    }
}
