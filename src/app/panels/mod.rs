//! The panels around the view. Each is a function of exactly what it shows; what a person does
//! comes back as commands. The helpers here give them one look.

pub mod cones;
pub mod discretization;
pub mod filter;
pub mod icon;
pub mod light;
mod light_editor;
mod light_method;
pub mod log;
pub mod measure;
pub mod memory;
pub mod node;
mod node_facts;
pub mod octree;
pub mod path_field;
pub mod plan;
pub mod reference;
pub mod scene;
mod slice;
mod surfaces;
pub mod table;
pub mod timeline;
pub mod timings;
pub mod top_bar;
pub mod tree;
pub mod tree_row;
pub mod view;

use std::ops::RangeInclusive;

use egui::{
    Align, CollapsingHeader, ComboBox, DragValue, Response, RichText, Slider, SliderClamping, Ui, WidgetInfo, vec2,
};

use super::command::Command;
use super::palette::Tone;

/// Of a list that is unfolded, before it scrolls.
const LIST_HEIGHT: f32 = 400.0;
/// Width of the names left of the controls.
const NAME_WIDTH: f32 = 76.0;

/// Sections that the window unfolds by itself.
pub const SCENE: &str = "Scene";
pub const LOG: &str = "Log";

/// A part of a side panel that can be folded away.
pub fn section(ui: &mut Ui, title: &str, open: bool, body: impl FnOnce(&mut Ui) -> Vec<Command>) -> Vec<Command> {
    section_revealed(ui, title, open, &mut None, body)
}

/// The same of one that is unfolded and scrolled to while `revealed` names it, which ends when it is.
pub fn section_revealed(
    ui: &mut Ui,
    title: &str,
    open: bool,
    revealed: &mut Option<&str>,
    body: impl FnOnce(&mut Ui) -> Vec<Command>,
) -> Vec<Command> {
    let is_revealed = *revealed == Some(title);
    let header = RichText::new(title).color(Tone::Strong.of(ui)).size(13.0);
    let shown = CollapsingHeader::new(header).id_salt(title).default_open(open).open(is_revealed.then_some(true));
    let shown = shown.show_unindented(ui, |ui| {
        ui.add_space(2.0);
        let commands = body(ui);
        ui.add_space(6.0);
        commands
    });
    ui.separator();
    if is_revealed {
        shown.header_response.scroll_to_me(Some(Align::TOP));
        if shown.fully_open() {
            *revealed = None;
        } else {
            ui.ctx().request_repaint();
        }
    }
    shown.body_returned.unwrap_or_default()
}

/// A named control: name left, control right, and the same tooltip over both.
pub fn control(ui: &mut Ui, name: &str, tip: &str, add: impl FnOnce(&mut Ui) -> Response) -> Response {
    let row = ui.horizontal(|ui| {
        let label = ui.allocate_ui_with_layout(
            vec2(NAME_WIDTH, ui.spacing().interact_size.y),
            egui::Layout::left_to_right(egui::Align::Center),
            |ui| {
                ui.set_min_width(NAME_WIDTH);
                ui.label(RichText::new(name).color(Tone::Weak.of(ui))).on_hover_text(tip)
            },
        );
        add(ui).labelled_by(label.inner.id).on_hover_text(tip)
    });
    row.inner
}

/// One of a few values as buttons side by side; whether another one was chosen.
pub fn switch<T: PartialEq + Copy>(ui: &mut Ui, value: &mut T, options: &[(T, &str, &str)]) -> bool {
    let mut changed = false;
    ui.spacing_mut().item_spacing.x = 2.0;
    for &(option, name, tip) in options {
        let button = egui::Button::selectable(*value == option, name).frame_when_inactive(true);
        if ui.add(button).on_hover_text(tip).clicked() && *value != option {
            *value = option;
            changed = true;
        }
    }
    changed
}

/// A named [`switch`].
pub fn choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
) -> bool {
    let mut changed = false;
    control(ui, name, tip, |ui| ui.horizontal(|ui| changed = switch(ui, value, options)).response);
    changed
}

/// One of many values as a list that unfolds.
pub fn list<T: PartialEq + Copy>(ui: &mut Ui, name: &str, tip: &str, value: &mut T, options: &[(T, &str, &str)]) {
    control(ui, name, tip, |ui| unfolding(ui, name, 120.0, value, options));
}

/// The list of a [`list`] alone.
pub fn unfolding<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    width: f32,
    value: &mut T,
    options: &[(T, &str, &str)],
) -> Response {
    let shown = options.iter().find(|option| option.0 == *value).map_or("", |option| option.1);
    let list = ComboBox::from_id_salt(name).width(width).height(LIST_HEIGHT).selected_text(shown);
    let list = list.show_ui(ui, |ui| {
        for &(option, name, tip) in options {
            ui.selectable_value(value, option, name).on_hover_text(tip);
        }
    });
    list.response
}

/// Controls that cannot be used for a reason, which their tip tells.
pub fn unless(ui: &mut Ui, reason: Option<&str>, add: impl FnOnce(&mut Ui)) {
    let shown = ui.add_enabled_ui(reason.is_none(), add);
    if let Some(reason) = reason {
        shown.response.on_hover_text(reason);
    }
}

/// A slider that leaves alone what nobody drags, also where it has more digits than are shown.
pub fn slider<N: egui::emath::Numeric>(value: &mut N, range: RangeInclusive<N>) -> Slider<'_> {
    Slider::new(value, range).clamping(SliderClamping::Edits)
}

/// A number that may be dragged, a hundredth of itself a point, and leaves alone what nobody drags.
pub fn number<N: egui::emath::Numeric>(value: &mut N, range: RangeInclusive<N>) -> DragValue<'_> {
    let speed = (value.to_f64().abs() * 0.01).max(0.01);
    DragValue::new(value).speed(speed).range(range).clamp_existing_to_range(false).update_while_editing(false)
}

/// Names a number that shows no name of its own.
pub fn named_number(response: &Response, value: f64, name: &str) {
    let label = Some(name.to_owned());
    response.widget_info(|| WidgetInfo { label: label.clone(), ..WidgetInfo::drag_value(true, value) });
}

/// A row of a grid of two columns: name and value, cut where it is too long and whole in the tip.
pub fn fact(ui: &mut Ui, name: &str, value: &str, tip: &str) {
    ui.label(RichText::new(name).color(Tone::Weak.of(ui)));
    ui.add(egui::Label::new(value).truncate()).on_hover_text(tip);
    ui.end_row();
}

/// A line of text for something that is not there.
pub fn nothing(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).color(Tone::Weak.of(ui)));
}

/// 1234567 as "1,234,567".
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// "12.3 MiB".
pub fn bytes(count: u64) -> String {
    bytesize::ByteSize::b(count).display().iec().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_are_grouped_by_thousands() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1000), "1,000");
        assert_eq!(grouped(12_345_678), "12,345,678");
    }
}
