//! A dense table: the first column takes the room that is left, numbers are aligned right.

use egui::{Align, Layout, Rect, RichText, Ui, vec2};
use egui_extras::{Column, TableBuilder};

use crate::app::palette::Tone;

const ROW_HEIGHT: f32 = 17.0;

pub struct Cell {
    text: String,
    color: Option<Tone>,
    tip: Option<String>,
    bar: f32,
}

impl Cell {
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), color: None, tip: None, bar: 0.0 }
    }

    pub fn color(self, color: Tone) -> Self {
        Self { color: Some(color), ..self }
    }

    pub fn tip(self, tip: impl Into<String>) -> Self {
        Self { tip: Some(tip.into()), ..self }
    }

    /// A bar behind the text, over this part of the cell's width.
    pub fn bar(self, part: f32) -> Self {
        Self { bar: part.clamp(0.0, 1.0), ..self }
    }

    fn show(&self, ui: &mut Ui) {
        if self.bar > 0.0 {
            let cell = ui.max_rect();
            let bar = Rect::from_x_y_ranges(cell.left()..=cell.left() + self.bar * cell.width(), cell.y_range());
            ui.painter().rect_filled(bar.shrink2(vec2(0.0, 1.5)), 1.0, Tone::Accent.of(ui).gamma_multiply(0.45));
        }
        let text = RichText::new(&self.text).color(self.color.map_or(ui.visuals().text_color(), |tone| tone.of(ui)));
        let label = ui.add(egui::Label::new(text).truncate().selectable(false));
        if let Some(tip) = &self.tip {
            label.on_hover_text(tip);
        }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::new(text)
    }
}

/// Column names with the width of all but the first, then the rows.
pub fn show(ui: &mut Ui, id: &str, columns: &[(&str, f32)], rows: Vec<Vec<Cell>>) {
    let mut table =
        TableBuilder::new(ui).id_salt(id).striped(true).vscroll(false).column(Column::remainder().clip(true));
    for (_, width) in &columns[1..] {
        table = table.column(Column::exact(*width).clip(true));
    }
    let header = table.header(ROW_HEIGHT, |mut row| {
        for (index, (name, _)) in columns.iter().enumerate() {
            row.col(|ui| aligned(ui, index, |ui| Cell::new(*name).color(Tone::Weak).show(ui)));
        }
    });
    header.body(|body| {
        body.rows(ROW_HEIGHT, rows.len(), |mut row| {
            for (index, cell) in rows[row.index()].iter().enumerate() {
                row.col(|ui| aligned(ui, index, |ui| cell.show(ui)));
            }
        });
    });
}

fn aligned(ui: &mut Ui, column: usize, add: impl FnOnce(&mut Ui)) {
    let layout = if column == 0 { Layout::left_to_right(Align::Center) } else { Layout::right_to_left(Align::Center) };
    ui.with_layout(layout, add);
}
