//! Notes that lie over the picture for a few seconds, and over nothing that is measured.

use std::time::Duration;

use egui::text::LayoutJob;
use egui::{Align, Align2, Area, Context, CursorIcon, Frame, Id, Label, Layout, Order, Rect, Response, Role};
use egui::{Sense, TextStyle, Ui, Vec2, WidgetInfo, vec2};

use super::palette::Tone;

/// From the edges of the picture; its captions are below.
const MARGIN: Vec2 = vec2(12.0, 38.0);
const MAX_WIDTH: f32 = 420.0;
/// Where the picture is narrower, notes lie over what is beside it.
const MIN_WIDTH: f32 = 140.0;
/// Of a note; the log has all of it.
const MAX_ROWS: usize = 8;
/// Older notes make room.
const MAX_SHOWN: usize = 4;

#[derive(Default)]
pub struct Toasts {
    /// Newest last.
    shown: Vec<Toast>,
    /// The window's clock, when they were shown last.
    clock_secs: f64,
}

struct Toast {
    text: String,
    tone: Tone,
    secs: f64,
    /// On the window's clock, from the first time it is shown.
    until_secs: Option<f64>,
}

impl Toasts {
    pub fn add(&mut self, text: impl Into<String>, tone: Tone, secs: f64) {
        self.shown.push(Toast { text: text.into(), tone, secs, until_secs: None });
        let surplus = self.shown.len().saturating_sub(MAX_SHOWN);
        self.shown.drain(..surplus);
    }

    /// Over the picture; whether one was clicked. What is pointed at stays.
    pub fn ui(&mut self, ctx: &Context, picture: Rect) -> bool {
        let now = ctx.input(|input| input.time);
        let passed = now - std::mem::replace(&mut self.clock_secs, now);
        if self.shown.is_empty() {
            return false;
        }
        let mut clicked = false;
        let before = self.shown.len();
        let width = (picture.width() - 2.0 * MARGIN.x).clamp(MIN_WIDTH, MAX_WIDTH);
        let area = Area::new(Id::unique("notes")).order(Order::Foreground).pivot(Align2::RIGHT_BOTTOM);
        area.fixed_pos(picture.right_bottom() - MARGIN).show(ctx, |ui| {
            ui.set_width(width);
            ui.with_layout(Layout::top_down(Align::Max), |ui| {
                self.shown.retain_mut(|toast| {
                    let response = toast.ui(ui, width);
                    let until = toast.until_secs.get_or_insert(now + toast.secs);
                    if response.contains_pointer() {
                        *until += passed;
                    }
                    clicked |= response.clicked();
                    now < *until && !response.clicked()
                });
            });
        });
        if self.shown.len() < before {
            // The others take their place.
            ctx.request_repaint();
        }
        let next = self.shown.iter().filter_map(|toast| toast.until_secs).reduce(f64::min);
        if let Some(until) = next {
            ctx.request_repaint_after(Duration::from_secs_f64((until - now).max(0.0)));
        }
        clicked
    }
}

impl Toast {
    fn ui(&self, ui: &mut Ui, width: f32) -> Response {
        let frame = Frame::popup(ui.style());
        let text_width = width - frame.total_margin().sum().x;
        let font = TextStyle::Body.resolve(ui.style());
        let mut text = LayoutJob::simple(self.text.clone(), font, self.tone.of(ui), text_width);
        text.wrap.max_rows = MAX_ROWS;
        let text = ui.fonts_mut(|fonts| fonts.layout_job(text));
        let shown = frame.show(ui, |ui| ui.add(Label::new(text).selectable(false)));
        let response = shown.response.interact(Sense::click()).on_hover_cursor(CursorIcon::PointingHand);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &self.text));
        response.on_hover_text("Shows it in the log.")
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    /// Shows them at a time of the window's clock, with the pointer at a place; where they are.
    fn frame(ctx: &Context, toasts: &mut Toasts, secs: f64, pointer: Option<egui::Pos2>) -> Option<Rect> {
        let events = pointer.map(egui::Event::PointerMoved).into_iter().collect();
        let picture = Rect::from_min_size(pos2(300.0, 40.0), vec2(600.0, 500.0));
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1200.0, 600.0)));
        let input = egui::RawInput { time: Some(secs), events, screen_rect, ..egui::RawInput::default() };
        let mut output = ctx.run_ui(input, |ui| {
            toasts.ui(ui.ctx(), picture);
        });
        output.textures_delta.clear();
        let rect = ctx.memory(|memory| memory.area_rect(Id::unique("notes")))?;
        (!toasts.shown.is_empty()).then_some(rect)
    }

    #[test]
    fn long_notes_wrap_within_the_picture() {
        let (ctx, mut toasts) = (Context::default(), Toasts::default());
        toasts.add("/no/spaces/in/this/path".repeat(40), Tone::Strong, 8.0);
        toasts.add("a sentence ".repeat(40), Tone::Strong, 8.0);
        let rect = [0.0, 0.1].map(|secs| frame(&ctx, &mut toasts, secs, None))[1].expect("shown");
        assert!(rect.left() > 300.0 && rect.right() < 900.0 && rect.bottom() < 540.0, "{rect}");
        assert!(rect.width() <= MAX_WIDTH + 1.0 && rect.height() > 100.0, "{rect}");
    }

    #[test]
    fn notes_go_after_their_time_unless_they_are_pointed_at() {
        let (ctx, mut toasts) = (Context::default(), Toasts::default());
        assert_eq!(frame(&ctx, &mut toasts, 100.0, None), None);
        toasts.add("short", Tone::Strong, 3.0);
        let rect = [200.0, 202.0].map(|secs| frame(&ctx, &mut toasts, secs, None))[1].expect("still there");
        let pointer = Some(rect.right_bottom() - vec2(8.0, 8.0));
        [202.1, 202.2, 300.0].into_iter().for_each(|secs| {
            frame(&ctx, &mut toasts, secs, pointer);
        });
        assert!(frame(&ctx, &mut toasts, 300.1, Some(pos2(10.0, 10.0))).is_some(), "time stood still");
        assert_eq!(frame(&ctx, &mut toasts, 305.0, None), None);
    }

    #[test]
    fn only_the_newest_notes_are_shown() {
        let mut toasts = Toasts::default();
        (0..9).for_each(|number| toasts.add(number.to_string(), Tone::Strong, 3.0));
        assert_eq!(toasts.shown.iter().map(|toast| &*toast.text).collect::<String>(), "5678");
    }
}
