//! A click that begins and ends within one frame of a busy window: what is pressed and released at once was never
//! dragged for egui, and a slider would miss it. Its release comes a frame later.

use egui::{Context, Event, Plugin, RawInput};

#[derive(Default)]
pub struct QuickClicks {
    /// From the release on.
    held: Vec<Event>,
}

impl Plugin for QuickClicks {
    fn debug_name(&self) -> &'static str {
        "quick clicks"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        input.events.splice(0..0, std::mem::take(&mut self.held));
        if let Some(release) = quick_release(&input.events) {
            self.held = input.events.split_off(release);
            ctx.request_repaint();
        }
    }
}

/// The first release of a button that these events have pressed.
fn quick_release(events: &[Event]) -> Option<usize> {
    let pressed = |event: &Event| match event {
        Event::PointerButton { button, pressed: true, .. } => Some(*button),
        _ => None,
    };
    (0..events.len()).find(|&at| match events[at] {
        Event::PointerButton { button, pressed: false, .. } => {
            events[..at].iter().filter_map(pressed).any(|before| before == button)
        }
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Modifiers, PointerButton, Pos2};

    fn event(pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos: Pos2::ZERO, button, pressed, modifiers }
    }

    #[test]
    fn every_press_has_a_frame_before_its_release() {
        let ctx = Context::default();
        let mut clicks = QuickClicks::default();
        let mut frame = |events: &[Event]| {
            let mut input = RawInput { events: events.to_vec(), ..RawInput::default() };
            clicks.input_hook(&ctx, &mut input);
            input.events
        };
        let twice = [event(true), event(false), event(true), event(false)];
        assert_eq!(frame(&twice), [event(true)]);
        assert_eq!(frame(&[]), [event(false), event(true)]);
        assert_eq!(frame(&[Event::Copy]), [event(false), Event::Copy]);
        assert_eq!(frame(&[event(true)]), [event(true)]);
        assert_eq!(frame(&[event(false)]), [event(false)], "an honest click is left alone");
    }
}
