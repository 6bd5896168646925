//! What the colours of the picture mean.

use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, pos2, vec2};

use super::theme;
use crate::color::srgb_byte;
use crate::settings::{ColorBy, Look, View};
use crate::stages::view::GHOST_COLORS;
use crate::stages::view::palette::legend_value;

const SIZE: egui::Vec2 = vec2(150.0, 10.0);

/// Over the picture, top left; nothing where colours speak for themselves.
pub fn paint(painter: &Painter, view: Rect, look: &Look) {
    let corner = view.left_top() + vec2(12.0, 12.0);
    match (look.view, look.color) {
        (View::Ghost, _) => swatches(
            painter,
            corner,
            &[
                (shown(GHOST_COLORS.holes), "hole: an exact cell that no moved voxel reached"),
                (shown(GHOST_COLORS.spill), "spill: a moved voxel outside the exact cells"),
                (shown(GHOST_COLORS.both), "both"),
            ],
        ),
        (_, ColorBy::Normal) => swatches(
            painter,
            corner,
            &[
                (Color32::from_rgb(255, 128, 128), "+x"),
                (Color32::from_rgb(128, 255, 128), "+y"),
                (Color32::from_rgb(128, 128, 255), "+z"),
            ],
        ),
        (View::Voxels, ColorBy::Occupancy) => ramp(painter, corner, ColorBy::Occupancy, "occupancy", ["0", "1"]),
        (View::Voxels, ColorBy::Level) => ramp(painter, corner, ColorBy::Level, "octree level", ["root", "leaves"]),
        _ => {}
    }
}

fn swatches(painter: &Painter, corner: Pos2, entries: &[(Color32, &str)]) {
    for (row, (color, name)) in entries.iter().enumerate() {
        let top = corner + vec2(0.0, 16.0 * row as f32);
        painter.rect_filled(Rect::from_min_size(top, vec2(10.0, 10.0)), 2.0, *color);
        text(painter, top + vec2(16.0, 5.0), Align2::LEFT_CENTER, name);
    }
}

/// The colour map as the picture uses it, with its ends named.
fn ramp(painter: &Painter, corner: Pos2, map: ColorBy, name: &str, ends: [&str; 2]) {
    const STEPS: usize = 48;
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let part = step as f32 / STEPS as f32;
        let [r, g, b] = legend_value(map, f64::from(part));
        let color = Color32::from_rgb(r, g, b);
        let x = corner.x + SIZE.x * part;
        mesh.colored_vertex(pos2(x, corner.y), color);
        mesh.colored_vertex(pos2(x, corner.y + SIZE.y), color);
        if step > 0 {
            let last = 2 * step as u32;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(Shape::mesh(mesh));
    let below = corner + vec2(0.0, SIZE.y + 3.0);
    text(painter, below, Align2::LEFT_TOP, ends[0]);
    text(painter, below + vec2(SIZE.x / 2.0, 0.0), Align2::CENTER_TOP, name);
    text(painter, below + vec2(SIZE.x, 0.0), Align2::RIGHT_TOP, ends[1]);
}

/// A linear colour of a shader as the picture shows it.
fn shown(linear: [f32; 4]) -> Color32 {
    let [r, g, b] = [0, 1, 2].map(|channel| srgb_byte(linear[channel]));
    Color32::from_rgb(r, g, b)
}

/// A line of text on a dark ground, inside the corner that `align` names.
pub fn caption(painter: &Painter, at: Pos2, align: Align2, text: &str) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.0), theme::STRONG);
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(6.0, 2.0)), 3.0, Color32::from_black_alpha(140));
    painter.galley(rect.min, galley, theme::STRONG);
}

/// Legible over any picture.
fn text(painter: &Painter, at: Pos2, align: Align2, text: &str) {
    let font = FontId::proportional(11.0);
    painter.text(at + vec2(1.0, 1.0), align, text, font.clone(), Color32::BLACK);
    painter.text(at, align, text, font, theme::STRONG);
}
