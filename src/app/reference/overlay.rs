//! Path-traced pixels over the picture: all of it, right of a divider, or what differs.

use std::ops::RangeInclusive;

use egui::{
    Align2, Color32, ColorImage, CursorIcon, Painter, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use image::RgbaImage;

use super::Comparison;
use super::pictures::{OfPicture, Pictures};
use crate::app::{legend, theme};

/// Around the divider, so that it can be taken hold of.
const GRIP: f32 = 12.0;
/// Below the upper edge of the view, under the legend.
const NAMES_DEPTH: f32 = 60.0;

/// As egui knows it.
pub struct Overlay {
    paths: egui::TextureHandle,
    difference: egui::TextureHandle,
}

impl Overlay {
    pub fn new(ctx: &egui::Context, pictures: &Pictures) -> Self {
        let texture = |name: &str, picture: &RgbaImage| {
            let [width, height] = [picture.width(), picture.height()].map(|side| side as usize);
            let pixels = ColorImage::from_rgba_unmultiplied([width, height], picture.as_raw());
            ctx.load_texture(name, pixels, egui::TextureOptions::NEAREST)
        };
        Self { paths: texture("paths", &pictures.paths), difference: texture("difference", &pictures.difference) }
    }

    /// Returns where the divider was dragged to.
    pub fn ui(&self, ui: &mut Ui, rect: Rect, comparison: Comparison, divider: f32) -> Option<f32> {
        let painter = ui.painter_at(rect);
        match comparison {
            Comparison::Cones => None,
            Comparison::Paths => {
                lay(&painter, &self.paths, rect, 0.0..=1.0);
                None
            }
            Comparison::Difference => {
                lay(&painter, &self.difference, rect, 0.0..=1.0);
                None
            }
            Comparison::Wipe => {
                lay(&painter, &self.paths, rect, divider..=1.0);
                divider_ui(ui, &painter, rect, divider)
            }
        }
    }
}

/// Of a picture that fills `rect`, what lies between these shares of its width.
fn lay(painter: &Painter, texture: &egui::TextureHandle, rect: Rect, shares: RangeInclusive<f32>) {
    let part = |rect: Rect| {
        let x = |share: f32| rect.left() + share * rect.width();
        Rect::from_x_y_ranges(x(*shares.start())..=x(*shares.end()), rect.y_range())
    };
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    painter.image(texture.id(), part(rect), part(whole), Color32::WHITE);
}

fn divider_ui(ui: &Ui, painter: &Painter, rect: Rect, divider: f32) -> Option<f32> {
    let x = rect.left() + divider * rect.width();
    let grip = Rect::from_center_size(pos2(x, rect.center().y), vec2(GRIP, rect.height())).intersect(rect);
    let response =
        ui.interact(grip, ui.scope_id().with("divider"), Sense::drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Divider of the picture"));
    let color = if response.hovered() || response.dragged() { theme::STRONG } else { theme::WEAK };
    painter.vline(x, rect.y_range(), Stroke::new(1.5, color));
    painter.circle(pos2(x, rect.center().y), 5.0, theme::BACKGROUND, Stroke::new(1.5, color));
    let y = rect.top() + NAMES_DEPTH;
    legend::caption(painter, pos2(x - 12.0, y), Align2::RIGHT_TOP, "cones");
    legend::caption(painter, pos2(x + 12.0, y), Align2::LEFT_TOP, "paths");
    let at = response.interact_pointer_pos().filter(|_| response.dragged())?;
    Some(((at.x - rect.left()) / rect.width()).clamp(0.0, 1.0))
}

/// The same in the pixels of a picture.
pub fn lay_over(picture: &mut RgbaImage, pictures: &Pictures, comparison: Comparison, divider: f32) {
    let (over, from) = match comparison {
        Comparison::Cones => return,
        Comparison::Paths => (&pictures.paths, 0),
        Comparison::Difference => (&pictures.difference, 0),
        Comparison::Wipe => (&pictures.paths, (divider * picture.width() as f32).round() as u32),
    };
    for (x, y, pixel) in over.enumerate_pixels().filter(|(x, ..)| *x >= from) {
        picture.put_pixel(x, y, *pixel);
    }
}

/// The same as linear light over that of cones; differences are signed.
pub fn lay_light_over(pixels: &mut [[f32; 4]], of: &OfPicture, comparison: Comparison, divider: f32) {
    let width = of.cones.size_px[0] as usize;
    let from = if comparison == Comparison::Wipe { (divider * width as f32).round() as usize } else { 0 };
    for (index, (pixel, path)) in pixels.iter_mut().zip(of.paths()).enumerate() {
        for (channel, path) in pixel.iter_mut().zip(path).filter(|_| index % width >= from) {
            match comparison {
                Comparison::Cones => {}
                Comparison::Paths | Comparison::Wipe => *channel = *path,
                Comparison::Difference => *channel -= path,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn a_picture_is_wiped_at_the_divider() {
        let of = |value| RgbaImage::from_pixel(4, 1, Rgba([value; 4]));
        let pictures = Pictures { paths: of(1), difference: of(2), most_difference: 1.0 };
        let row = |comparison| {
            let mut picture = of(0);
            lay_over(&mut picture, &pictures, comparison, 0.5);
            picture.pixels().map(|pixel| pixel.0[0]).collect::<Vec<_>>()
        };
        assert_eq!(row(Comparison::Cones), [0; 4]);
        assert_eq!(row(Comparison::Wipe), [0, 0, 1, 1]);
        assert_eq!(row(Comparison::Paths), [1; 4]);
        assert_eq!(row(Comparison::Difference), [2; 4]);
    }
}
