//! Undo and redo of everything that is set: grid, filter, view, camera, what is hidden. Only the time
//! is left out: the timeline goes back and forth by itself, and plays on.
//!
//! Changes that follow each other closely, as of a drag, are one step.

use egui::util::undoer::Undoer;

use crate::settings::Settings;

/// A change that comes later than this after the last begins a new step.
const PAUSE_SECS: f64 = 0.6;

#[derive(Default)]
pub struct Undo {
    steps: Undoer<Settings>,
    /// What was set at the end of the last frame; `None` before the first.
    last: Option<Settings>,
    changed_at_secs: f64,
}

impl Undo {
    /// Once a frame, with what is set now.
    pub fn note(&mut self, now: Settings, clock_secs: f64) {
        let Some(last) = self.last.as_ref().filter(|last| **last != now) else {
            self.last.get_or_insert(now);
            return;
        };
        if clock_secs - self.changed_at_secs > PAUSE_SECS {
            self.steps.add_undo(last);
        }
        (self.changed_at_secs, self.last) = (clock_secs, Some(now));
    }

    pub fn step(&mut self, now: &Settings, back: bool) -> Option<Settings> {
        let step = if back { self.steps.undo(now) } else { self.steps.redo(now) };
        let step = step.cloned();
        if step.is_some() {
            // The next change begins a step of its own.
            self.changed_at_secs = f64::NEG_INFINITY;
            self.last.clone_from(&step);
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_level(level: u32) -> Settings {
        let mut settings = Settings::default();
        settings.method.look.level = Some(level);
        settings
    }

    #[test]
    fn steps_go_back_and_forth_and_close_changes_are_one() {
        let mut undo = Undo::default();
        undo.note(at_level(0), 0.0);
        // A drag of half a second, then another change.
        (1..=5).for_each(|level| undo.note(at_level(level), 1.0 + 0.1 * f64::from(level)));
        undo.note(at_level(7), 5.0);
        assert_eq!(undo.step(&at_level(7), true), Some(at_level(5)));
        assert_eq!(undo.step(&at_level(5), true), Some(at_level(0)));
        assert_eq!(undo.step(&at_level(0), true), None);
        assert_eq!(undo.step(&at_level(0), false), Some(at_level(5)));
        undo.note(at_level(5), 6.0);
        undo.note(at_level(1), 6.1);
        assert_eq!(undo.step(&at_level(1), false), None, "a change ends what could be redone");
        assert_eq!(undo.step(&at_level(1), true), Some(at_level(5)));
    }
}
