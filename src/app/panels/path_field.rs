//! A field for a path. The end of a path tells most of it, so that is what a long one shows until it is edited.

use std::sync::Arc;

use egui::{Galley, Response, TextBuffer, TextEdit, TextStyle, Ui, vec2};

/// `name`: no other field of the window has it.
pub fn path_field(ui: &mut Ui, name: &str, path: &mut String, width: f32) -> Response {
    let id = ui.make_persistent_id(name);
    let is_edited = ui.memory(|memory| memory.has_focus(id));
    let mut layout = |ui: &Ui, text: &dyn TextBuffer, room: f32| end_of(ui, text.as_str(), room);
    let field = TextEdit::singleline(path).id(id).hint_text("a path").desired_width(width);
    if is_edited { ui.add(field) } else { ui.add(field.layouter(&mut layout)) }
}

/// The text in a line, moved to the left by what exceeds a width.
fn end_of(ui: &Ui, text: &str, width: f32) -> Arc<Galley> {
    let (font, color) = (TextStyle::Body.resolve(ui.style()), ui.visuals().widgets.inactive.text_color());
    let line = ui.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, color));
    let excess = line.size().x - width;
    if excess <= 0.0 {
        return line;
    }
    let mut line = Galley::clone(&line);
    for row in &mut line.rows {
        row.pos.x -= excess;
    }
    line.mesh_bounds = line.mesh_bounds.translate(vec2(-excess, 0.0));
    line.rect.max.x -= excess;
    Arc::new(line)
}
