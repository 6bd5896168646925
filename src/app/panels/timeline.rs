//! The clock of the scene: clip, play, step, scrub, loop, speed; and the turn of everything.

use egui::{ComboBox, DragValue, Slider, Ui};

use super::icon::{self, Icon};
use super::named_number;
use crate::app::command::Command;
use crate::app::palette::{self, Tone};
use crate::app::playback::Playback;
use crate::scene::Clip;
use crate::settings::MotionSettings;

const REST_POSE: &str = "Rest pose";

/// `clip`: the one that `motion` names; `shown_secs`: the time that the picture on screen shows.
pub fn ui(
    ui: &mut Ui,
    (clips, clip): (&[Clip], Option<&Clip>),
    (motion, shown_secs): (&MotionSettings, Option<f64>),
    playback: &Playback,
) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal_centered(|ui| {
        commands.extend(clip_ui(ui, clips, clip, motion));
        let playable = clip.is_some_and(|clip| clip.duration_secs > 0.0);
        ui.add_enabled_ui(playable, |ui| commands.extend(transport_ui(ui, playback)));
        turn_and_scrub_ui(ui, clip, (motion, shown_secs), playable, &mut commands);
    });
    commands
}

fn clip_ui(ui: &mut Ui, clips: &[Clip], clip: Option<&Clip>, motion: &MotionSettings) -> Option<Command> {
    let mut chosen = None;
    let shown = match clip {
        Some(clip) => clip.name.as_str(),
        None if clips.is_empty() => "No animation",
        None => REST_POSE,
    };
    let combo = ComboBox::from_id_salt("clip").width(130.0).truncate().selected_text(shown);
    let shown = ui.add_enabled_ui(!clips.is_empty(), |ui| {
        combo.show_ui(ui, |ui| {
            for candidate in clips {
                let name = format!("{} ({:.2} s)", candidate.name, candidate.duration_secs);
                if ui.selectable_label(clip.is_some_and(|clip| std::ptr::eq(clip, candidate)), name).clicked() {
                    chosen = Some(candidate.name.clone());
                }
            }
            if ui.selectable_label(clip.is_none(), REST_POSE).clicked() {
                chosen = Some(String::new());
            }
        })
    });
    let response = shown.inner.response.on_hover_text("The animation clip that moves the scene.");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, !clips.is_empty(), "Clip"));
    chosen.map(|name| Command::Move(MotionSettings { clip: Some(name), time_secs: 0.0, ..motion.clone() }))
}

fn transport_ui(ui: &mut Ui, playback: &Playback) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.spacing_mut().item_spacing.x = 2.0;
    if icon::button(ui, Icon::StepBack, "Step back", "One step of 1/30 s back (←).").clicked() {
        commands.push(Command::Step(-1));
    }
    let (icon, name) = if playback.is_playing() { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
    if icon::button(ui, icon, name, "Plays or pauses the clip (space).").clicked() {
        commands.push(Command::TogglePlaying);
    }
    if icon::button(ui, Icon::StepForward, "Step forward", "One step of 1/30 s ahead (→).").clicked() {
        commands.push(Command::Step(1));
    }
    ui.add_space(4.0);
    let mut looped = playback.looped;
    if ui.toggle_value(&mut looped, "Loop").on_hover_text("Begins again at the end of the clip.").changed() {
        commands.push(Command::Loop(looped));
    }
    let mut speed = playback.speed;
    let drag = DragValue::new(&mut speed).speed(0.01).range(-8.0..=8.0).fixed_decimals(2).suffix(" ×");
    let response = ui.add(drag).on_hover_text("Speed of playing: seconds of the clip a second. Negative plays back.");
    named_number(&response, speed, "Speed");
    if response.changed() {
        commands.push(Command::Speed(speed));
    }
    commands
}

/// The turn at the right end, the scrub slider in all the room between.
fn turn_and_scrub_ui(
    ui: &mut Ui,
    clip: Option<&Clip>,
    (motion, shown_secs): (&MotionSettings, Option<f64>),
    playable: bool,
    commands: &mut Vec<Command>,
) {
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        commands.extend(turn_ui(ui, motion));
        ui.separator();
        picture_time_ui(ui, shown_secs.filter(|_| playable), motion.time_secs);
        ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
            let duration = clip.map_or(0.0, |clip| clip.duration_secs);
            let mut time = motion.time_secs.min(duration);
            ui.spacing_mut().slider_width = (ui.available_width() - 112.0).max(60.0);
            let slider = Slider::new(&mut time, 0.0..=duration.max(f64::MIN_POSITIVE))
                // Not by decimals, which would round the time itself.
                .custom_formatter(|time, _| format!("{time:.3}"))
                .suffix(format!(" / {duration:.2} s"))
                .smart_aim(false);
            let response =
                ui.add_enabled(playable, slider).on_hover_text("Time of the clip in seconds; drag to scrub.");
            response.widget_info(|| egui::WidgetInfo::slider(playable, time, "Time"));
            if response.changed() {
                commands.push(Command::Move(MotionSettings { time_secs: time, ..motion.clone() }));
            }
        });
    });
}

/// The picture follows the timeline: how far it has come.
fn picture_time_ui(ui: &mut Ui, shown_secs: Option<f64>, wanted_secs: f64) {
    let Some(shown_secs) = shown_secs else { return };
    let tone = if shown_secs == wanted_secs { Tone::Weak } else { Tone::Warning };
    // As wide for every time, so that nothing beside it moves.
    let text = egui::RichText::new(format!("shown {shown_secs:>7.3} s")).color(tone.of(ui)).monospace();
    let tip = "The time that the picture on screen shows; the timeline may be ahead of it.";
    ui.label(text).on_hover_text(tip);
}

fn turn_ui(ui: &mut Ui, motion: &MotionSettings) -> Option<Command> {
    let mut turn = motion.turn_degrees;
    let axes = ["Turn x", "Turn y", "Turn z"].into_iter().zip(palette::axes(ui));
    for (degrees, (name, color)) in turn.iter_mut().zip(axes).rev() {
        let drag = DragValue::new(degrees).speed(0.5).range(-360.0..=360.0).max_decimals(2).suffix("°");
        let response =
            ui.add(drag).on_hover_text("Turns the whole scene about its centre: a rigid motion of everything.");
        named_number(&response, *degrees, name);
        ui.colored_label(color, &name[5..]);
    }
    (turn != motion.turn_degrees).then(|| Command::Move(MotionSettings { turn_degrees: turn, ..motion.clone() }))
}
