//! The node that a person looks at: under the pointer, or pinned and left by its pointers. What is
//! stored of it is read only while its panel is unfolded and nothing is being built or drawn.

use egui::{Pos2, Rect, Response};

use super::stage::Stage;
use crate::engine::{Engine, EngineError, NodeAddress, NodeFacts};

/// What a person does with a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pin {
    /// Stays with this node, wherever the pointer goes.
    To(NodeAddress),
    /// Back to the one pinned before.
    Back,
    /// Follows the pointer again.
    Release,
}

#[derive(Default)]
pub struct Inspector {
    /// Its panel is unfolded.
    pub is_open: bool,
    hovered: Option<NodeAddress>,
    pinned: Option<NodeAddress>,
    /// Where a node is to be pinned, once nothing is built or drawn any more.
    clicked: Option<Pos2>,
    /// Pinned before, the last one at the end.
    before: Vec<NodeAddress>,
    /// Where the pointer was, and of which results, when `hovered` was read.
    picked: Option<(Pos2, u64)>,
    read: Option<Reading>,
}

/// What was read of an address from the build of this number.
struct Reading {
    address: NodeAddress,
    build: u64,
    facts: Option<NodeFacts>,
}

impl Inspector {
    pub fn apply(&mut self, pin: Pin) {
        match pin {
            Pin::To(address) if self.pinned == Some(address) => {}
            Pin::To(address) => {
                self.before.extend(self.pinned);
                self.pinned = Some(address);
            }
            Pin::Back => self.pinned = self.before.pop(),
            Pin::Release => (self.pinned, self.before) = (None, Vec::new()),
        }
    }

    /// The node looked at.
    pub fn address(&self) -> Option<NodeAddress> {
        self.pinned.or(self.hovered)
    }

    pub fn is_pinned(&self) -> bool {
        self.pinned.is_some()
    }

    pub fn can_go_back(&self) -> bool {
        !self.before.is_empty()
    }

    /// What is stored of the node looked at, as far as it was read. `None` inside: nothing is.
    pub fn facts(&self) -> Option<Option<&NodeFacts>> {
        let read = self.read.as_ref().filter(|read| Some(read.address) == self.address())?;
        Some(read.facts.as_ref())
    }

    /// Address and build of what was read.
    fn read_of(&self) -> Option<(NodeAddress, u64)> {
        self.read.as_ref().map(|read| (read.address, read.build))
    }

    /// Reads which node the pointer is over, where it or the results are others than last time; pins it
    /// where it was clicked.
    fn pick(&mut self, engine: &Engine, at: Option<(Pos2, [u32; 2])>, results: u64) -> Result<(), EngineError> {
        // Outside the picture, the last node stays: its links are there.
        let Some((pos, pixel)) = at else { return Ok(()) };
        if let Some(clicked) = self.clicked.take_if(|clicked| *clicked == pos) {
            self.picked = Some((clicked, results));
            self.hovered = engine.node_at(pixel)?;
            self.hovered.into_iter().for_each(|address| self.apply(Pin::To(address)));
        } else if self.pinned.is_none() && self.picked != Some((pos, results)) {
            self.picked = Some((pos, results));
            self.hovered = engine.node_at(pixel)?;
        }
        Ok(())
    }

    /// Reads the facts of the node looked at, where it or the build is another than last time.
    fn update(&mut self, engine: &Engine, build: u64) -> Result<(), EngineError> {
        let Some(address) = self.address() else { return Ok(()) };
        if self.read_of() != Some((address, build)) {
            let facts = engine.node_facts(address)?;
            self.read = Some(Reading { address, build, facts });
        }
        Ok(())
    }

    /// Once a frame, after the picture, while its panel is unfolded. Alt and a click pin the node under the pointer.
    pub fn follow(&mut self, ui: &egui::Ui, response: &Response, stage: &Stage) -> Result<(), EngineError> {
        if response.clicked() && ui.input(|input| input.modifiers.alt) {
            self.clicked = response.interact_pointer_pos();
        }
        if stage.working().is_some() || stage.error().is_some() {
            return Ok(());
        }
        let picture_px = stage.picture().map(crate::gpu::GpuTexture::size_px);
        let at = self.clicked.or(response.hover_pos()).zip(picture_px);
        let at = at.and_then(|(pos, size_px)| Some((pos, pixel_at(response.rect, pos, size_px)?)));
        // What was clicked may no longer be in the view.
        self.clicked = self.clicked.filter(|_| at.is_some());
        let before = self.read_of();
        let read = self.pick(&stage.engine, at, stage.results).and_then(|()| self.update(&stage.engine, stage.builds));
        // The panel was laid out before.
        if self.read_of() != before {
            ui.ctx().request_repaint();
        }
        read
    }
}

/// Which of a picture's pixels lies at a place of its rectangle.
fn pixel_at(rect: Rect, pos: Pos2, size_px: [u32; 2]) -> Option<[u32; 2]> {
    let share = (pos - rect.min) / rect.size();
    let pixel = [share.x * size_px[0] as f32, share.y * size_px[1] as f32];
    let is_inside = rect.contains(pos) && pixel.iter().zip(size_px).all(|(at, size)| *at >= 0.0 && *at < size as f32);
    is_inside.then(|| pixel.map(|at| at as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn pins_are_left_and_come_back() {
        let [a, b] = [1, 2].map(|level| NodeAddress { level, cell: [0; 3] });
        let mut inspector = Inspector { hovered: Some(b), ..Inspector::default() };
        assert_eq!(inspector.address(), Some(b));
        inspector.apply(Pin::To(a));
        inspector.apply(Pin::To(b));
        inspector.apply(Pin::To(b));
        assert!(inspector.address() == Some(b) && inspector.can_go_back());
        inspector.apply(Pin::Back);
        assert!(inspector.address() == Some(a) && !inspector.can_go_back() && inspector.is_pinned());
        inspector.apply(Pin::Release);
        assert!(inspector.address() == Some(b) && !inspector.is_pinned());
    }

    #[test]
    fn a_place_in_the_view_is_a_pixel_also_of_a_coarse_picture() {
        let rect = Rect::from_min_size(pos2(100.0, 50.0), vec2(200.0, 100.0));
        assert_eq!(pixel_at(rect, pos2(100.0, 50.0), [200, 100]), Some([0, 0]));
        assert_eq!(pixel_at(rect, pos2(299.5, 149.5), [200, 100]), Some([199, 99]));
        assert_eq!(pixel_at(rect, pos2(299.5, 149.5), [50, 25]), Some([49, 24]));
        assert_eq!(pixel_at(rect, pos2(99.0, 60.0), [200, 100]), None);
        assert_eq!(pixel_at(Rect::from_min_size(rect.min, vec2(0.0, 0.0)), rect.min, [1, 1]), None);
    }
}
