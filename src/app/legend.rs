//! What the colours of the picture mean.

use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, pos2, vec2};

use super::numbers::signed;
use super::scale_ticks::{Tick, ticks};
use super::theme;
use crate::accuracy::picture_error::difference_color;
use crate::color::srgb_byte;
use crate::settings::{ColorBy, Look, Slice, SliceValue, SurfaceView, ToneCurve, View};
use crate::stages::view::GHOST_COLORS;
use crate::stages::view::palette::legend_value;
use crate::stages::view::show_surfaces::tone_mapped;

const SIZE: egui::Vec2 = vec2(150.0, 10.0);
/// Room that a legend takes from the upper edge of the view.
pub const HEIGHT: f32 = 64.0;
/// Room for numbers below.
const SCALE_WIDTH: f32 = 260.0;

/// What the colours of the last picture stand for, where they are of light.
#[derive(Clone, Copy, Debug)]
pub struct Values {
    /// What light was multiplied by before it was shown.
    pub exposure: f64,
    /// Ends of the colour scale of a slice or a shadow map.
    pub range: Option<[f64; 2]>,
}

/// Over the picture, top left; nothing where colours speak for themselves.
pub fn paint(painter: &Painter, view: Rect, look: &Look, values: Values) {
    let corner = view.left_top() + vec2(12.0, 12.0);
    match (look.view, look.color) {
        (View::Slice, _) => slice(painter, corner, &look.slice, values),
        (View::ShadowMap, _) => shadow_map(painter, corner, values.range),
        (View::Voxels, ColorBy::Radiance) => toned(painter, corner, RADIANCE, values, ToneCurve::Linear),
        (View::Voxels, ColorBy::Irradiance) => toned(painter, corner, IRRADIANCE, values, ToneCurve::Linear),
        (View::Surfaces, _) => surfaces(painter, corner, look, values),
        (View::Ghost, _) => swatches(
            painter,
            corner,
            &[
                (shown(GHOST_COLORS.holes), "hole: an exact cell that no moved voxel reached"),
                (shown(GHOST_COLORS.spill), "spill: a moved voxel outside the exact cells"),
                (shown(GHOST_COLORS.both), "both"),
            ],
        ),
        (_, ColorBy::Normal) => axes(painter, corner),
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

fn axes(painter: &Painter, corner: Pos2) {
    let colors = [(255, 128, 128), (128, 255, 128), (128, 128, 255)].map(|(r, g, b)| Color32::from_rgb(r, g, b));
    swatches(painter, corner, &[(colors[0], "+x"), (colors[1], "+y"), (colors[2], "+z")]);
}

/// The colour map as the picture uses it, with its ends named.
fn ramp(painter: &Painter, corner: Pos2, map: ColorBy, name: &str, ends: [&str; 2]) {
    bar(painter, Rect::from_min_size(corner, SIZE), |part| legend_value(map, part));
    let below = corner + vec2(0.0, SIZE.y + 3.0);
    text(painter, below, Align2::LEFT_TOP, ends[0]);
    text(painter, below + vec2(SIZE.x / 2.0, 0.0), Align2::CENTER_TOP, name);
    text(painter, below + vec2(SIZE.x, 0.0), Align2::RIGHT_TOP, ends[1]);
}

/// A bar of colours: sRGB bytes of a part, 0 left to 1 right.
fn bar(painter: &Painter, rect: Rect, color: impl Fn(f64) -> [u8; 3]) {
    const STEPS: usize = 48;
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let part = step as f32 / STEPS as f32;
        let [r, g, b] = color(f64::from(part));
        let x = rect.left() + rect.width() * part;
        for y in [rect.top(), rect.bottom()] {
            mesh.colored_vertex(pos2(x, y), Color32::from_rgb(r, g, b));
        }
        if step > 0 {
            let last = 2 * step as u32;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// A bar with numbers below it, each at its part of the bar.
fn scale(painter: &Painter, corner: Pos2, name: &str, ticks: &[Tick], color: impl Fn(f64) -> [u8; 3]) {
    let rect = Rect::from_min_size(corner, vec2(SCALE_WIDTH, SIZE.y));
    bar(painter, rect, color);
    for tick in ticks {
        let at = pos2(rect.left() + rect.width() * tick.part as f32, rect.bottom());
        let ends = [at + vec2(0.0, -3.0), at + vec2(0.0, 2.0)];
        painter.line_segment(ends, egui::Stroke::new(1.0, theme::STRONG));
        let align = match tick.part {
            part if part < 0.05 => Align2::LEFT_TOP,
            part if part > 0.95 => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        text(painter, at + vec2(0.0, 3.0), align, &tick.label);
    }
    text(painter, rect.left_bottom() + vec2(0.0, 18.0), Align2::LEFT_TOP, name);
}

const RADIANCE: &str = "radiance, nits";
const IRRADIANCE: &str = "irradiance, lux";

/// Light up to what is white under this curve.
fn toned(painter: &Painter, corner: Pos2, name: &str, values: Values, curve: ToneCurve) {
    let white = white(curve);
    let name = format!("{name}; exposure {} stops", signed(values.exposure.log2(), 1));
    let ticks = ticks([0.0, white / values.exposure], false);
    scale(painter, corner, &name, &ticks, |part| [srgb_byte(tone_mapped(curve, part * white) as f32); 3]);
}

/// Exposed light that a curve makes white, or, where it never does, nearly so.
fn white(curve: ToneCurve) -> f64 {
    match curve {
        ToneCurve::Linear => 1.0,
        ToneCurve::Reinhard | ToneCurve::Aces => 8.0,
    }
}

/// Of a map of differences: what its colours stand for.
pub fn differences(painter: &Painter, view: Rect, part: SurfaceView, most: f64) {
    let corner = view.left_top() + vec2(12.0, 12.0);
    let unit = if part.is_light() { "nits" } else { "of 1" };
    let name = format!("cones less paths, luminance, {unit}");
    // The map is as bright as the text.
    let ground = Rect::from_min_size(corner, vec2(SCALE_WIDTH, 44.0)).expand(8.0);
    painter.rect_filled(ground, 3.0, Color32::from_black_alpha(200));
    scale(painter, corner, &name, &ticks([-most, most], false), |part| difference_color(2.0 * part - 1.0));
}

fn surfaces(painter: &Painter, corner: Pos2, look: &Look, values: Values) {
    let light = |name: &str| toned(painter, corner, name, values, look.tone_curve);
    let share = |name: &str| {
        let color = |part: f64| [srgb_byte(part as f32); 3];
        scale(painter, corner, name, &ticks([0.0, 1.0], false), color);
    };
    match look.surface {
        SurfaceView::Final => light(RADIANCE),
        SurfaceView::Direct => light("direct radiance, nits"),
        SurfaceView::Diffuse => light("indirect diffuse radiance, nits"),
        SurfaceView::Specular => light("indirect specular radiance, nits"),
        SurfaceView::Irradiance => light("indirect irradiance, lux"),
        SurfaceView::Ao => share("share of the hemisphere without anything near"),
        SurfaceView::Roughness => share("roughness"),
        SurfaceView::Normal => axes(painter, corner),
        SurfaceView::Depth => {
            let ticks = values.range.map(|range| ticks(range, false)).unwrap_or_default();
            let color = |part| legend_value(ColorBy::Occupancy, 1.0 - part);
            scale(painter, corner, "distance from the eye, scene units", &ticks, color);
        }
        SurfaceView::Albedo => {}
    }
}

fn slice(painter: &Painter, corner: Pos2, slice: &Slice, values: Values) {
    let name = match slice.value {
        SliceValue::Radiance => "luminance of the radiance, nits",
        SliceValue::Irradiance => "luminance of the irradiance, lux",
        SliceValue::Occupancy => "occupancy",
    };
    let map = slice.value.color();
    let ticks = values.range.map(|range| ticks(range, slice.logarithmic)).unwrap_or_default();
    let name = if slice.logarithmic { format!("{name}, logarithmic") } else { name.to_owned() };
    scale(painter, corner, &name, &ticks, |part| legend_value(map, part));
}

/// A sun is at no place: its distances begin where it meets the grid.
fn shadow_map(painter: &Painter, corner: Pos2, range: Option<[f64; 2]>) {
    let is_sun = range.is_some_and(|[least, _]| least != 0.0);
    let from = if is_sun { "the grid's corner nearest to the sun" } else { "the light" };
    let ticks = range.map(|[least, most]| ticks([0.0, most - least], false)).unwrap_or_default();
    let color = |part| legend_value(ColorBy::Occupancy, part);
    scale(painter, corner, &format!("depth from {from}, scene units"), &ticks, color);
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
