//! The look of the window: spacing, and over the picture the colours that it always has. What panels are coloured by
//! is in [`super::palette`].

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Theme, Visuals, vec2};

use super::numbers;
use super::palette::{DARK, LIGHT, Palette};

/// Of the viewport where there is no picture, and behind what lies over it.
pub const BACKGROUND: Color32 = DARK.sunken;
pub const STRONG: Color32 = DARK.strong;
pub const WEAK: Color32 = DARK.weak;
pub const WARNING: Color32 = DARK.warning;
pub const ERROR: Color32 = DARK.error;
/// Along x, y and z.
pub const AXES: [Color32; 3] = DARK.axes;

/// Applies palettes and spacing. `is_chosen`: a person has chosen between dark and light before; it is dark otherwise.
pub fn apply(ctx: &egui::Context, is_chosen: bool) {
    if !is_chosen {
        ctx.set_theme(Theme::Dark);
    }
    ctx.set_visuals_of(Theme::Dark, visuals(Visuals::dark(), &DARK));
    ctx.set_visuals_of(Theme::Light, visuals(Visuals::light(), &LIGHT));
    ctx.all_styles_mut(|style| {
        let font = |size, family| FontId::new(size, family);
        style.text_styles = [
            (TextStyle::Heading, font(15.0, FontFamily::Proportional)),
            (TextStyle::Body, font(12.5, FontFamily::Proportional)),
            (TextStyle::Button, font(12.5, FontFamily::Proportional)),
            (TextStyle::Small, font(11.0, FontFamily::Proportional)),
            (TextStyle::Monospace, font(11.5, FontFamily::Monospace)),
        ]
        .into();
        let spacing = &mut style.spacing;
        spacing.item_spacing = vec2(6.0, 4.0);
        spacing.button_padding = vec2(7.0, 2.0);
        spacing.interact_size = vec2(28.0, 20.0);
        spacing.indent = 16.0;
        spacing.slider_width = 130.0;
        spacing.menu_margin = Margin::same(5);
        spacing.tooltip_width = 320.0;
        spacing.scroll = egui::style::ScrollStyle::thin();
        style.number_formatter = egui::style::NumberFormatter::new(numbers::edited);
        style.interaction.tooltip_delay = 0.35;
    });
}

fn visuals(mut visuals: Visuals, palette: &Palette) -> Visuals {
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.sunken;
    visuals.faint_bg_color = palette.faint;
    visuals.weak_text_color = Some(palette.weak);
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.hyperlink_color = palette.accent;
    visuals.selection.bg_fill = palette.selected;
    visuals.selection.stroke = Stroke::new(1.0, palette.strong);
    visuals.slider_trailing_fill = true;
    visuals.window_corner_radius = CornerRadius::same(4);
    visuals.menu_corner_radius = CornerRadius::same(4);
    let widgets = &mut visuals.widgets;
    for (widget, fill, text) in [
        (&mut widgets.noninteractive, palette.panel, palette.text),
        (&mut widgets.inactive, palette.control, palette.text),
        (&mut widgets.hovered, palette.hovered, palette.strong),
        (&mut widgets.active, palette.selected, palette.strong),
        (&mut widgets.open, palette.hovered, palette.strong),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, palette.line);
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(3);
        widget.expansion = 0.0;
    }
    visuals
}
