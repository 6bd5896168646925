//! The bar above everything: what is open, what the program is doing, and the panels' switches.

use egui::{Align, Button, Label, Layout, ProgressBar, RichText, Role, ThemePreference, Ui, WidgetInfo, vec2};

use crate::app::command::Command;
use crate::app::palette::Tone;

/// Narrower windows have no room for the program's name and the GPU.
const WIDE: f32 = 1000.0;
/// Narrower windows have their actions in the menu.
const BUTTONS: f32 = 800.0;
/// What the program is doing has this room, wide and narrow, whatever it does: nothing beside it moves.
const STATUS_WIDTHS: [f32; 2] = [240.0, 150.0];
const BAR_WIDTHS: [f32; 2] = [90.0, 56.0];
/// Longer names of scenes are cut.
const NAME_WIDTHS: [f32; 2] = [260.0, 110.0];

/// What is shown; nothing here is kept.
pub struct TopBar<'a> {
    pub scene: Option<&'a str>,
    /// What is going on and how far, which may be cancelled.
    pub loading: Option<(&'a str, f32)>,
    /// How far the frame is that the GPU works on.
    pub frame: Option<f32>,
    /// How far the exact voxelization is.
    pub exact: Option<f32>,
    /// How far the path tracer is.
    pub paths: Option<f32>,
    pub adapter: &'a str,
}

/// Which side panels are unfolded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unfolded {
    pub controls: bool,
    pub tree: bool,
    pub measurements: bool,
}

/// Name, tip and what it does.
type Action = (&'static str, &'static str, Command);

const ACTIONS: [Action; 3] = [
    ("Undo", "Takes back the last change of anything but the time (Ctrl+Z).", Command::Undo),
    ("Redo", "Sets again what was undone (Ctrl+Shift+Z).", Command::Redo),
    ("Screenshot", "Saves the view as PNG with its settings inside (Ctrl+S).", Command::SaveScreenshot),
];

pub fn ui(ui: &mut Ui, bar: &TopBar<'_>, unfolded: &mut Unfolded) -> Vec<Command> {
    let mut commands = Vec::new();
    let is_wide = ui.available_width() >= WIDE;
    let has_buttons = ui.available_width() >= BUTTONS;
    ui.horizontal_centered(|ui| {
        let tip = "Shows or hides the controls on the left.";
        ui.toggle_value(&mut unfolded.controls, "Controls").on_hover_text(tip);
        let tip = "Shows or hides the scene tree: what the file holds, node by node (T).";
        ui.toggle_value(&mut unfolded.tree, "Tree").on_hover_text(tip);
        ui.separator();
        if is_wide {
            ui.label(RichText::new("Octolume").color(Tone::Accent.of(ui)).heading());
        }
        let name = RichText::new(bar.scene.unwrap_or("no scene")).color(Tone::Strong.of(ui)).heading();
        ui.scope(|ui| {
            ui.set_max_width(sized(NAME_WIDTHS, is_wide));
            ui.add(Label::new(name).truncate());
        });
        commands.extend(status_ui(ui, bar, is_wide));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let help = ui.button("?").on_hover_text("Lists all keys and gestures (F1).");
            help.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Help"));
            if help.clicked() {
                commands.push(Command::ToggleHelp);
            }
            let tip = "Shows or hides the measurements on the right.";
            ui.toggle_value(&mut unfolded.measurements, "Measurements").on_hover_text(tip);
            ui.separator();
            commands.extend(menu_ui(ui, bar, has_buttons));
            if has_buttons {
                // From the right: the last one comes first.
                let clicked = ACTIONS.into_iter().rev().filter(|action| action_ui(ui, bar, action));
                commands.extend(clicked.map(|(.., command)| command));
            }
            if is_wide {
                ui.separator();
                let adapter = Label::new(RichText::new(bar.adapter).color(Tone::Weak.of(ui))).truncate();
                ui.add(adapter).on_hover_text("The GPU everything runs on.");
            }
        });
    });
    commands
}

/// Wide or narrow.
fn sized([wide, narrow]: [f32; 2], is_wide: bool) -> f32 {
    if is_wide { wide } else { narrow }
}

fn action_ui(ui: &mut Ui, bar: &TopBar<'_>, (name, tip, command): &Action) -> bool {
    let is_enabled = *command != Command::SaveScreenshot || bar.scene.is_some();
    ui.add_enabled(is_enabled, Button::new(*name)).on_hover_text(*tip).clicked()
}

/// What a narrow window has no buttons for, and the colours.
fn menu_ui(ui: &mut Ui, bar: &TopBar<'_>, has_buttons: bool) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.menu_button("Menu", |ui| {
        if !has_buttons {
            let clicked = ACTIONS.into_iter().filter(|action| action_ui(ui, bar, action));
            commands.extend(clicked.map(|(.., command)| command));
            ui.separator();
        }
        let now = ui.options(|options| options.theme_preference);
        for (theme, name, tip) in [
            (ThemePreference::Dark, "Dark colours", "Light text on dark panels."),
            (ThemePreference::Light, "Light colours", "Dark text on light panels."),
            (ThemePreference::System, "Colours of the desktop", "Dark or light, as the desktop says."),
        ] {
            if ui.radio(now == theme, name).on_hover_text(tip).clicked() {
                commands.push(Command::Theme(theme));
            }
        }
    });
    commands
}

fn status_ui(ui: &mut Ui, bar: &TopBar<'_>, is_wide: bool) -> Option<Command> {
    let size = vec2(sized(STATUS_WIDTHS, is_wide), ui.available_height());
    let width = sized(BAR_WIDTHS, is_wide);
    let slot = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(size.x);
        let of_frame = [(bar.frame, "building"), (bar.exact, "exact voxels"), (bar.paths, "tracing paths")];
        let on_its_way = of_frame.into_iter().find_map(|(fraction, name)| Some((fraction?, name)));
        if let Some((title, fraction)) = bar.loading {
            return loading_ui(ui, (title, fraction), width);
        }
        if let Some((fraction, name)) = on_its_way {
            ui.add(ProgressBar::new(fraction).desired_width(width).desired_height(6.0));
            ui.add(Label::new(RichText::new(name).color(Tone::Accent.of(ui))).truncate());
        } else {
            ui.label(RichText::new("ready").color(Tone::Weak.of(ui)));
        }
        None
    });
    slot.inner
}

fn loading_ui(ui: &mut Ui, (title, fraction): (&str, f32), width: f32) -> Option<Command> {
    let cancelled = ui.button("Cancel").on_hover_text("Keeps the scene that is open.").clicked();
    ui.add(ProgressBar::new(fraction).desired_width(width).show_percentage());
    ui.add(Label::new(title).truncate()).on_hover_text(title);
    cancelled.then_some(Command::CancelLoading)
}
