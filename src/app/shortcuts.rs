//! Keys of the whole window. A control that has the keyboard's focus gets them instead.

use egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::commands::Command;

const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);

pub fn commands(ui: &Ui) -> Vec<Command> {
    let focused = ui.memory(|memory| memory.focused().is_some());
    ui.input_mut(|input| {
        let mut commands = Vec::new();
        if input.consume_shortcut(&OPEN) {
            commands.push(Command::ChooseFile);
        }
        if input.consume_shortcut(&SAVE) {
            commands.push(Command::SaveScreenshot);
        }
        if !focused {
            for (key, command) in [
                (Key::Space, Command::TogglePlaying),
                (Key::ArrowLeft, Command::Step(-1)),
                (Key::ArrowRight, Command::Step(1)),
                (Key::F, Command::FrameAll),
            ] {
                if input.consume_key(Modifiers::NONE, key) {
                    commands.push(command);
                }
            }
        }
        commands
    })
}
