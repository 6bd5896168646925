//! Keys of the whole window. A control that has the keyboard's focus gets them instead; the scene
//! tree takes only those it walks by.

use egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::command::Command;
use super::panels::tree;

const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);

/// Work also while a person walks the scene tree.
const LETTERS: [(Modifiers, Key, Command); 8] = [
    (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z, Command::Redo),
    (Modifiers::COMMAND, Key::Z, Command::Undo),
    (Modifiers::COMMAND, Key::Y, Command::Redo),
    (Modifiers::SHIFT, Key::H, Command::Isolate),
    (Modifiers::ALT, Key::H, Command::ShowAll),
    (Modifiers::NONE, Key::H, Command::ToggleShown),
    (Modifiers::NONE, Key::F, Command::Frame),
    (Modifiers::NONE, Key::T, Command::ToggleTree),
];

const TIMELINE: [(Modifiers, Key, Command); 3] = [
    (Modifiers::NONE, Key::Space, Command::TogglePlaying),
    (Modifiers::NONE, Key::ArrowLeft, Command::Step(-1)),
    (Modifiers::NONE, Key::ArrowRight, Command::Step(1)),
];

pub fn commands(ui: &Ui) -> Vec<Command> {
    let focused = ui.memory(|memory| memory.focused());
    let letters = LETTERS.into_iter().filter(|_| focused.is_none_or(|id| id == tree::focus_id()));
    let keys = letters.chain(TIMELINE.into_iter().filter(|_| focused.is_none()));
    ui.input_mut(|input| {
        let mut commands = Vec::new();
        if input.consume_shortcut(&OPEN) {
            commands.push(Command::ChooseFile);
        }
        if input.consume_shortcut(&SAVE) {
            commands.push(Command::SaveScreenshot);
        }
        // Consuming ignores Shift and Alt that a key does not name: those that name one come first.
        for (modifiers, key, command) in keys {
            if input.consume_key(modifiers, key) {
                commands.push(command);
            }
        }
        commands
    })
}
