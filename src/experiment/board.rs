//! What a procedure and the one who advances it tell each other.

use std::cell::{Cell, Ref, RefCell, RefMut};
use std::rc::Rc;
use std::time::Duration;

use image::RgbaImage;

use crate::settings::Settings;

/// Something that a person should know, a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Remark {
    /// Of what is measured.
    Warning(String),
    /// Why a row is missing.
    Missing(String),
}

impl Remark {
    pub fn sentence(&self) -> &str {
        match self {
            Self::Warning(sentence) | Self::Missing(sentence) => sentence,
        }
    }
}

/// A picture beside a row.
pub struct NamedPicture {
    /// Of its file, without folder and extension.
    pub name: String,
    pub picture: RgbaImage,
    /// That it was made with.
    pub settings: Settings,
}

#[derive(Default)]
pub(super) struct Board {
    pub budget: Cell<Duration>,
    pub fraction: Cell<f32>,
    pub doing: RefCell<String>,
    pub waits_for_thread: Cell<bool>,
    pub remarks: RefCell<Vec<Remark>>,
    pub pictures: RefCell<Vec<NamedPicture>>,
    /// Counts the changes of what was found.
    pub changes: Cell<u64>,
}

impl Board {
    /// A frame that begins again, and a total that grows, are no step back.
    pub fn reach(&self, share: Share, fraction: f32) {
        self.fraction.set(self.fraction.get().max(share.at(fraction.clamp(0.0, 1.0))));
    }
}

/// What a procedure has found so far.
pub(super) struct Findings<R> {
    rows: RefCell<R>,
    board: Rc<Board>,
}

impl<R> Findings<R> {
    pub fn new(rows: R, board: Rc<Board>) -> Self {
        Self { rows: RefCell::new(rows), board }
    }

    pub fn borrow(&self) -> Ref<'_, R> {
        self.rows.borrow()
    }

    /// Counts as a change.
    pub fn borrow_mut(&self) -> RefMut<'_, R> {
        self.board.changes.update(|changes| changes + 1);
        self.rows.borrow_mut()
    }
}

/// A part of the whole that a step of a procedure stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Share {
    from: f32,
    to: f32,
}

impl Share {
    pub const WHOLE: Self = Self { from: 0.0, to: 1.0 };

    /// A step that is not counted, after this much of the whole.
    pub fn none_after(fraction: f32) -> Self {
        Self { from: fraction, to: fraction }
    }

    /// How much of the whole is done with this part of it.
    pub fn at(self, fraction: f32) -> f32 {
        self.from + (self.to - self.from) * fraction
    }

    /// One of `count` equal parts.
    pub fn part(self, index: usize, count: usize) -> Self {
        let at = |index: usize| self.at(index as f32 / count.max(1) as f32);
        Self { from: at(index), to: at(index + 1) }
    }

    /// Parts one after the other, as long as their weights.
    pub fn split<const N: usize>(self, weights: [f32; N]) -> [Self; N] {
        let total: f32 = weights.iter().sum();
        let mut before = 0.0;
        weights.map(|weight| {
            let from = before / total;
            before += weight;
            Self { from: self.at(from), to: self.at(before / total) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_fill_the_whole_in_order() {
        let [first, second] = Share::WHOLE.split([1.0, 3.0]);
        assert_eq!((first.at(0.0), first.at(1.0), second.at(0.0), second.at(1.0)), (0.0, 0.25, 0.25, 1.0));
        assert_eq!((second.part(1, 3).at(0.0), second.part(1, 3).at(1.0)), (0.5, 0.75));
        let [nothing, all] = Share::WHOLE.split([0.0, 2.0]);
        assert_eq!((nothing.at(1.0), all.at(1.0)), (0.0, 1.0));
    }
}
