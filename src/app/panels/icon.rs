//! Buttons of the timeline: drawn, because fonts lack their symbols, and named for who cannot see them.

use egui::{Color32, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    Play,
    Pause,
    StepBack,
    StepForward,
}

pub fn button(ui: &mut Ui, icon: Icon, name: &str, tip: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(28.0, 22.0), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    let style = ui.style().interact(&response);
    ui.painter().rect(rect, style.corner_radius, style.weak_bg_fill, style.bg_stroke, egui::StrokeKind::Inside);
    paint(ui.painter(), Rect::from_center_size(rect.center(), vec2(10.0, 10.0)), icon, style.fg_stroke.color);
    response.on_hover_text(tip)
}

fn paint(painter: &Painter, rect: Rect, icon: Icon, color: Color32) {
    let bar = |from: f32, to: f32| {
        let x = |part: f32| rect.left() + part * rect.width();
        painter.rect_filled(Rect::from_x_y_ranges(x(from)..=x(to), rect.y_range()), 1.0, color);
    };
    match icon {
        Icon::Play => triangle(painter, rect, 0.05, 1.0, color),
        Icon::Pause => {
            bar(0.08, 0.38);
            bar(0.62, 0.92);
        }
        Icon::StepBack => {
            bar(0.0, 0.2);
            triangle(painter, rect, 1.0, 0.25, color);
        }
        Icon::StepForward => {
            triangle(painter, rect, 0.0, 0.75, color);
            bar(0.8, 1.0);
        }
    }
}

/// Points from one part of the width to another.
fn triangle(painter: &Painter, rect: Rect, from: f32, to: f32, color: Color32) {
    let at = |x: f32, y: f32| -> Pos2 { pos2(rect.left() + x * rect.width(), rect.top() + y * rect.height()) };
    let corners = vec![at(from, 0.0), at(to, 0.5), at(from, 1.0)];
    painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
}
