//! The look of the window: one dark palette, dense spacing, and the few colours that carry a meaning.

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Theme, Visuals, vec2};

/// Behind everything, and of the viewport where there is no picture.
pub const BACKGROUND: Color32 = Color32::from_rgb(17, 19, 22);
const PANEL: Color32 = Color32::from_rgb(25, 27, 31);
const CONTROL: Color32 = Color32::from_rgb(43, 47, 54);
const CONTROL_HOVERED: Color32 = Color32::from_rgb(56, 62, 71);
const LINE: Color32 = Color32::from_rgb(46, 50, 57);
const TEXT: Color32 = Color32::from_rgb(206, 211, 218);
pub const STRONG: Color32 = Color32::from_rgb(240, 243, 247);
pub const WEAK: Color32 = Color32::from_rgb(137, 145, 156);

/// What is selected or runs.
pub const ACCENT: Color32 = Color32::from_rgb(64, 178, 164);
const ACCENT_DARK: Color32 = Color32::from_rgb(24, 92, 86);
pub const WARNING: Color32 = Color32::from_rgb(232, 184, 86);
pub const ERROR: Color32 = Color32::from_rgb(238, 108, 98);
/// Cells of the exact set that no moved voxel reached.
pub const HOLE: Color32 = Color32::from_rgb(236, 84, 74);
/// Cells that moved voxels reached outside the exact set.
pub const SPILL: Color32 = Color32::from_rgb(92, 148, 245);

/// Along x, y and z.
pub const AXES: [Color32; 3] =
    [Color32::from_rgb(255, 120, 110), Color32::from_rgb(130, 210, 120), Color32::from_rgb(110, 160, 255)];

/// Words behind nodes of the scene tree.
pub const TAG_JOINT: Color32 = Color32::from_rgb(176, 148, 226);
pub const TAG_CAMERA: Color32 = Color32::from_rgb(120, 170, 230);
pub const TAG_LIGHT: Color32 = Color32::from_rgb(222, 204, 112);

/// Applies palette and spacing; the window is dark whatever the system's theme.
pub fn apply(ctx: &egui::Context) {
    ctx.set_theme(Theme::Dark);
    ctx.all_styles_mut(|style| {
        style.visuals = visuals();
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
        style.interaction.tooltip_delay = 0.35;
    });
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = PANEL;
    visuals.window_fill = PANEL;
    visuals.window_stroke = Stroke::new(1.0, LINE);
    visuals.extreme_bg_color = BACKGROUND;
    visuals.faint_bg_color = Color32::from_rgb(30, 33, 38);
    visuals.weak_text_color = Some(WEAK);
    visuals.warn_fg_color = WARNING;
    visuals.error_fg_color = ERROR;
    visuals.hyperlink_color = ACCENT;
    visuals.selection.bg_fill = ACCENT_DARK;
    visuals.selection.stroke = Stroke::new(1.0, STRONG);
    visuals.slider_trailing_fill = true;
    visuals.window_corner_radius = CornerRadius::same(4);
    visuals.menu_corner_radius = CornerRadius::same(4);
    let widgets = &mut visuals.widgets;
    for (widget, fill, text) in [
        (&mut widgets.noninteractive, PANEL, TEXT),
        (&mut widgets.inactive, CONTROL, TEXT),
        (&mut widgets.hovered, CONTROL_HOVERED, STRONG),
        (&mut widgets.active, ACCENT_DARK, STRONG),
        (&mut widgets.open, CONTROL_HOVERED, STRONG),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, LINE);
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(3);
        widget.expansion = 0.0;
    }
    visuals
}
