//! Which side panels are shown: those that a person wants, as far as a narrow window has room for them beside the
//! picture. What folds by itself comes back with the room; what a person unfolds stays, and the others give way.

use super::panels::top_bar::Unfolded;

/// Narrower windows fold the measurements.
const MEASUREMENTS_ROOM: f32 = 1100.0;
/// Narrower windows fold the controls too.
const CONTROLS_ROOM: f32 = 800.0;
/// The picture is never narrower, in a window of this width and more.
pub const PICTURE_WIDTH: f32 = 190.0;

pub const CONTROLS_WIDTHS: [f32; 2] = [250.0, 480.0];
pub const TREE_WIDTHS: [f32; 2] = [180.0, 640.0];
pub const MEASUREMENTS_WIDTHS: [f32; 2] = [260.0, 620.0];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Controls,
    Tree,
    Measurements,
}

/// The first ones give way first.
const SIDES: [Side; 3] = [Side::Measurements, Side::Controls, Side::Tree];

impl Side {
    fn least_width(self) -> f32 {
        match self {
            Self::Controls => CONTROLS_WIDTHS[0],
            Self::Tree => TREE_WIDTHS[0],
            Self::Measurements => MEASUREMENTS_WIDTHS[0],
        }
    }

    /// Of a window that has room for it by itself.
    fn room(self) -> f32 {
        match self {
            Self::Controls => CONTROLS_ROOM,
            Self::Tree => 0.0,
            Self::Measurements => MEASUREMENTS_ROOM,
        }
    }

    fn is_in(self, unfolded: Unfolded) -> bool {
        match self {
            Self::Controls => unfolded.controls,
            Self::Tree => unfolded.tree,
            Self::Measurements => unfolded.measurements,
        }
    }

    fn set(self, unfolded: &mut Unfolded, is_unfolded: bool) {
        match self {
            Self::Controls => unfolded.controls = is_unfolded,
            Self::Tree => unfolded.tree = is_unfolded,
            Self::Measurements => unfolded.measurements = is_unfolded,
        }
    }
}

#[derive(Default)]
pub struct Folding {
    /// Unfolded by hand in a window that folds them; the last one at the end.
    insisted: Vec<Side>,
    /// What the last frame began with.
    shown: Unfolded,
}

impl Folding {
    /// What a window of this width shows.
    pub fn shown(&mut self, wanted: Unfolded, width: f32) -> Unfolded {
        self.insisted.retain(|side| width < MEASUREMENTS_ROOM && side.is_in(wanted));
        let mut shown = wanted;
        for side in SIDES.into_iter().filter(|side| width < side.room() && !self.insisted.contains(side)) {
            side.set(&mut shown, false);
        }
        let by_themselves = SIDES.into_iter().filter(|side| !self.insisted.contains(side));
        for side in by_themselves.chain(self.insisted.iter().copied()) {
            if least_width(shown) + PICTURE_WIDTH <= width {
                break;
            }
            side.set(&mut shown, false);
        }
        self.shown = shown;
        shown
    }

    /// A person has folded or unfolded one: `now` is what is to be shown.
    pub fn note(&mut self, wanted: &mut Unfolded, now: Unfolded) {
        for side in SIDES.into_iter().filter(|side| side.is_in(now) != side.is_in(self.shown)) {
            side.set(wanted, side.is_in(now));
            self.insisted.retain(|other| *other != side);
            if side.is_in(now) {
                self.insisted.push(side);
            }
        }
    }

    /// Folds what is shown, and unfolds what is not.
    pub fn toggle(&mut self, wanted: &mut Unfolded, side: Side) {
        let mut now = self.shown;
        side.set(&mut now, !side.is_in(self.shown));
        self.note(wanted, now);
    }
}

fn least_width(shown: Unfolded) -> f32 {
    SIDES.into_iter().filter(|side| side.is_in(shown)).map(Side::least_width).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WANTED: Unfolded = Unfolded { controls: true, tree: false, measurements: true };

    fn sides(unfolded: Unfolded) -> Vec<Side> {
        SIDES.into_iter().filter(|side| side.is_in(unfolded)).collect()
    }

    #[test]
    fn panels_fold_by_themselves_and_come_back_with_the_room() {
        let mut folding = Folding::default();
        let mut at = |width| sides(folding.shown(WANTED, width));
        assert_eq!(at(1440.0), [Side::Measurements, Side::Controls]);
        assert_eq!(at(1000.0), [Side::Controls]);
        assert_eq!(at(700.0), []);
        assert_eq!(at(1000.0), [Side::Controls]);
        assert_eq!(at(1440.0), [Side::Measurements, Side::Controls]);
    }

    #[test]
    fn what_a_person_does_stays() {
        let (mut folding, mut wanted) = (Folding::default(), WANTED);
        assert_eq!(sides(folding.shown(wanted, 900.0)), [Side::Controls]);
        folding.toggle(&mut wanted, Side::Measurements);
        assert_eq!(sides(folding.shown(wanted, 900.0)), [Side::Measurements, Side::Controls]);
        folding.toggle(&mut wanted, Side::Controls);
        assert_eq!(sides(folding.shown(wanted, 900.0)), [Side::Measurements]);
        assert_eq!(sides(folding.shown(wanted, 1440.0)), [Side::Measurements], "folded by hand");
        assert_eq!(sides(folding.shown(wanted, 900.0)), [], "another narrow window folds again");
    }

    #[test]
    fn the_picture_always_has_room_and_the_last_one_unfolded_stays() {
        let (mut folding, mut wanted) = (Folding::default(), WANTED);
        for side in [Side::Controls, Side::Tree, Side::Measurements, Side::Controls] {
            folding.shown(wanted, 640.0);
            if !sides(folding.shown).contains(&side) {
                folding.toggle(&mut wanted, side);
            }
            let shown = folding.shown(wanted, 640.0);
            assert!(least_width(shown) + PICTURE_WIDTH <= 640.0, "{shown:?}");
            assert!(sides(shown).contains(&side), "{side:?} was unfolded last: {shown:?}");
        }
    }
}
