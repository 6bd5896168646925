//! Keys of the whole window: one table, which is read here and listed by the help. A control that has the keyboard's
//! focus gets its keys instead; the scene tree takes only those it walks by.

use egui::{Context, Id, Key, KeyboardShortcut, Modifiers, Ui};

use super::command::Command;
use super::panels::tree;

/// When a key is taken, by what has the keyboard's focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Taken {
    /// Whatever has it.
    Always,
    /// Also while a person walks the scene tree.
    Walking,
    /// Nothing may have it.
    Unfocused,
}

/// A key, and what it does.
pub struct Shortcut {
    taken: Taken,
    modifiers: Modifiers,
    key: Key,
    command: Command,
    pub does: &'static str,
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = CTRL.plus(Modifiers::SHIFT);
const NONE: Modifiers = Modifiers::NONE;

/// Consuming ignores Shift and Alt that a key does not name: those that name one come first.
pub static SHORTCUTS: [Shortcut; 15] = [
    shortcut(Taken::Always, CTRL, Key::O, Command::ChooseFile, "opens a file"),
    shortcut(Taken::Always, CTRL, Key::S, Command::SaveScreenshot, "saves the picture with its settings"),
    shortcut(Taken::Walking, CTRL_SHIFT, Key::Z, Command::Redo, "sets again what was undone"),
    shortcut(Taken::Walking, CTRL, Key::Z, Command::Undo, "takes back the last change"),
    shortcut(Taken::Walking, CTRL, Key::Y, Command::Redo, "sets again what was undone"),
    shortcut(Taken::Unfocused, NONE, Key::Space, Command::TogglePlaying, "plays or pauses the clip"),
    shortcut(Taken::Unfocused, NONE, Key::ArrowLeft, Command::Step(-1), "goes back by 1/30 s"),
    shortcut(Taken::Unfocused, NONE, Key::ArrowRight, Command::Step(1), "goes ahead by 1/30 s"),
    shortcut(Taken::Walking, NONE, Key::F, Command::Frame, "brings the selected node, or all that is shown, into view"),
    shortcut(Taken::Walking, NONE, Key::T, Command::ToggleTree, "shows or hides the scene tree"),
    shortcut(Taken::Walking, Modifiers::SHIFT, Key::H, Command::Isolate, "shows the selected node alone"),
    shortcut(Taken::Walking, Modifiers::ALT, Key::H, Command::ShowAll, "shows every node"),
    shortcut(Taken::Walking, NONE, Key::H, Command::ToggleShown, "hides the selected node, or shows it again"),
    shortcut(Taken::Always, NONE, Key::F1, Command::ToggleHelp, "shows or hides this list"),
    shortcut(Taken::Walking, NONE, Key::Questionmark, Command::ToggleHelp, "shows or hides this list"),
];

const fn shortcut(taken: Taken, modifiers: Modifiers, key: Key, command: Command, does: &'static str) -> Shortcut {
    Shortcut { taken, modifiers, key, command, does }
}

impl Shortcut {
    /// As it is written on keyboards, "Ctrl+S".
    pub fn name(&self, ctx: &Context) -> String {
        let name = ctx.format_shortcut(&KeyboardShortcut::new(self.modifiers, self.key));
        name.replace(Key::Questionmark.name(), Key::Questionmark.symbol_or_name())
    }

    fn is_taken(&self, focused: Option<Id>) -> bool {
        match self.taken {
            Taken::Always => true,
            Taken::Walking => focused.is_none_or(|id| id == tree::focus_id()),
            Taken::Unfocused => focused.is_none(),
        }
    }
}

pub fn commands(ui: &Ui) -> Vec<Command> {
    let focused = ui.memory(|memory| memory.focused());
    let taken = SHORTCUTS.iter().filter(|shortcut| shortcut.is_taken(focused));
    ui.input_mut(|input| {
        let pressed = taken.filter(|shortcut| input.consume_key(shortcut.modifiers, shortcut.key));
        pressed.map(|shortcut| shortcut.command.clone()).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Event, RawInput};

    #[test]
    fn every_key_of_the_table_does_what_its_row_says() {
        for shortcut in &SHORTCUTS {
            let (key, modifiers) = (shortcut.key, shortcut.modifiers);
            let event = Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
            let mut done = Vec::new();
            let input = RawInput { events: vec![event], ..RawInput::default() };
            let mut output = Context::default().run_ui(input, |ui| done.extend(commands(ui)));
            output.textures_delta.clear();
            assert_eq!(done, std::slice::from_ref(&shortcut.command), "{modifiers:?} {key:?}");
        }
    }

    #[test]
    fn keys_are_called_as_on_keyboards() {
        let ctx = Context::default();
        let names: Vec<String> = SHORTCUTS.iter().map(|shortcut| shortcut.name(&ctx)).collect();
        for name in ["Ctrl+S", "Ctrl+Shift+Z", "Shift+H", "Space", "F1", "?"] {
            assert!(names.iter().any(|known| known == name), "{name}: {names:?}");
        }
    }
}
