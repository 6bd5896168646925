//! What is kept of one kind of part: a few instances, each with the key it was made from.
//!
//! An instance that begins to be written has no key until it is done, also when the frame fails. What is overwritten
//! first is what nobody can ask for again: broken instances, then those of another moment. What other methods made of
//! this moment stays, up to [`KEPT_OF_A_PART`] instances and as long as there is memory.

use std::any::Any;
use std::collections::HashSet;

use super::times::PassTiming;
use crate::digest::Digest;
use crate::plan::Key;

/// More methods than these are compared by nobody at once.
pub const KEPT_OF_A_PART: usize = 4;

/// What a frame tells of itself when it begins a part.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Number of the frame.
    pub frame: u64,
    /// What the part shows of: instances of another moment are overwritten first.
    pub moment: Digest,
    /// Another instance may be made beside those that are there.
    pub has_room: bool,
}

/// Keys that may not be overwritten or dropped.
pub type Pinned = HashSet<Digest>;

#[derive(Debug)]
pub struct Pool<T>(Vec<Instance<T>>);

#[derive(Debug)]
struct Instance<T> {
    content: T,
    key: Option<Key>,
    /// `false` while it is written.
    is_made: bool,
    timings: Vec<PassTiming>,
    /// The last frame that called for it.
    used: u64,
    moment: Digest,
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: Default> Pool<T> {
    fn place(&self, key: &Key) -> Option<usize> {
        self.0.iter().position(|instance| instance.key.as_ref() == Some(key))
    }

    /// An instance that is made, or recorded before in this frame.
    pub fn get(&self, key: &Key) -> Option<&T> {
        Some(&self.0[self.place(key)?].content)
    }

    /// One that is made.
    pub fn finished(&self, key: &Key) -> Option<&T> {
        let instance = &self.0[self.place(key)?];
        instance.is_made.then_some(&instance.content)
    }

    pub fn get_mut(&mut self, key: &Key) -> Option<&mut T> {
        let place = self.place(key)?;
        Some(&mut self.0[place].content)
    }

    /// Takes an instance out to be written for `key`; [`Self::put`] brings it back.
    pub fn begin(&mut self, key: &Key, turn: &Turn, pinned: &Pinned) -> T {
        let place = self.place(key).unwrap_or_else(|| self.free_place(turn, pinned));
        let instance = &mut self.0[place];
        (instance.key, instance.is_made) = (Some(key.clone()), false);
        (instance.used, instance.moment) = (turn.frame, turn.moment);
        instance.timings.clear();
        std::mem::take(&mut instance.content)
    }

    pub fn put(&mut self, key: &Key, content: T) {
        if let Some(place) = self.place(key) {
            self.0[place].content = content;
        }
    }

    fn free_place(&mut self, turn: &Turn, pinned: &Pinned) -> usize {
        let is_pinned =
            |instance: &Instance<T>| instance.key.as_ref().is_some_and(|key| pinned.contains(&key.digest()));
        let free = (0..self.0.len()).filter(|&place| !is_pinned(&self.0[place]));
        let oldest = free.min_by_key(|&place| {
            let instance = &self.0[place];
            (instance.key.is_some(), instance.moment == turn.moment, instance.used)
        });
        let is_worthless = |place: usize| self.0[place].key.is_none() || self.0[place].moment != turn.moment;
        match oldest {
            Some(place) if is_worthless(place) || self.0.len() >= KEPT_OF_A_PART || !turn.has_room => place,
            _ => {
                let (timings, moment) = (Vec::new(), turn.moment);
                self.0.push(Instance { content: T::default(), key: None, is_made: false, timings, used: 0, moment });
                self.0.len() - 1
            }
        }
    }
}

/// What is done with pools of all kinds alike.
pub trait Keeper: Any {
    fn keys(&self) -> Vec<(u64, Key)>;
    /// `key` was called for by frame number `frame`.
    fn touch(&mut self, key: &Key, frame: u64);
    /// It is written completely.
    fn finish(&mut self, key: &Key, timings: Vec<PassTiming>);
    fn timings(&self, key: &Key) -> &[PassTiming];
    /// The frame has failed: what it was writing holds nothing.
    fn fail(&mut self);
    /// Nothing holds any more; buffers stay, to be written again.
    fn forget(&mut self);
    /// The same of what was made from this input.
    fn forget_made_from(&mut self, input: &Key);
    /// When the oldest instance that may be dropped was used last.
    fn oldest(&self, pinned: &Pinned) -> Option<u64>;
    fn drop_oldest(&mut self, pinned: &Pinned);
}

impl<T: Default> Pool<T> {
    fn oldest_place(&self, pinned: &Pinned) -> Option<usize> {
        let is_free = |instance: &Instance<T>| instance.key.as_ref().is_none_or(|key| !pinned.contains(&key.digest()));
        (0..self.0.len()).filter(|&place| is_free(&self.0[place])).min_by_key(|&place| self.0[place].used)
    }
}

impl<T: Default + 'static> Keeper for Pool<T> {
    fn keys(&self) -> Vec<(u64, Key)> {
        let made = self.0.iter().filter(|instance| instance.is_made);
        made.filter_map(|instance| Some((instance.used, instance.key.clone()?))).collect()
    }

    fn touch(&mut self, key: &Key, frame: u64) {
        if let Some(place) = self.place(key) {
            self.0[place].used = frame;
        }
    }

    fn finish(&mut self, key: &Key, timings: Vec<PassTiming>) {
        if let Some(place) = self.place(key) {
            (self.0[place].is_made, self.0[place].timings) = (true, timings);
        }
    }

    fn timings(&self, key: &Key) -> &[PassTiming] {
        self.place(key).map_or(&[], |place| &self.0[place].timings)
    }

    fn fail(&mut self) {
        self.0.iter_mut().filter(|instance| !instance.is_made).for_each(|instance| instance.key = None);
    }

    fn forget(&mut self) {
        self.0.iter_mut().for_each(|instance| instance.key = None);
    }

    fn forget_made_from(&mut self, input: &Key) {
        let is_made_from = |key: &Key| key.inputs().any(|(_, from)| from == input);
        let made = self.0.iter_mut().filter(|instance| instance.key.as_ref().is_some_and(is_made_from));
        made.for_each(|instance| instance.key = None);
    }

    fn oldest(&self, pinned: &Pinned) -> Option<u64> {
        self.oldest_place(pinned).map(|place| self.0[place].used)
    }

    fn drop_oldest(&mut self, pinned: &Pinned) {
        if let Some(place) = self.oldest_place(pinned) {
            self.0.remove(place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Part;

    fn key(value: u32) -> Key {
        Key::of(Part::Masks).shot("a value", &value).build()
    }

    fn turn(frame: u64, moment: u32) -> Turn {
        Turn { frame, moment: Digest::of(&moment), has_room: true }
    }

    fn make(pool: &mut Pool<u32>, value: u32, turn: &Turn, pinned: &Pinned) {
        pool.begin(&key(value), turn, pinned);
        pool.put(&key(value), value);
        pool.finish(&key(value), Vec::new());
    }

    #[test]
    fn an_instance_has_no_key_until_it_is_done() {
        let mut pool = Pool::<u32>::default();
        pool.begin(&key(1), &turn(1, 0), &Pinned::new());
        pool.put(&key(1), 7);
        assert!(pool.keys().is_empty() && pool.get(&key(1)) == Some(&7));
        pool.fail();
        assert_eq!(pool.get(&key(1)), None);
    }

    #[test]
    fn what_is_of_another_moment_is_overwritten_and_the_rest_kept() {
        let mut pool = Pool::<u32>::default();
        (1..=3).for_each(|value| make(&mut pool, value, &turn(value.into(), 0), &Pinned::new()));
        assert_eq!(pool.keys().len(), 3, "methods of one moment lie beside one another");
        make(&mut pool, 9, &turn(4, 1), &Pinned::from([key(1).digest()]));
        assert!(pool.get(&key(2)).is_none() && pool.get(&key(1)).is_some(), "the oldest that is not pinned");
        let crowded = Turn { has_room: false, ..turn(5, 1) };
        make(&mut pool, 10, &crowded, &Pinned::new());
        make(&mut pool, 11, &crowded, &Pinned::new());
        make(&mut pool, 12, &crowded, &Pinned::new());
        assert!(pool.get(&key(9)).is_none() && pool.0.len() == 3, "without room the oldest of this moment goes");
    }

    #[test]
    fn no_part_is_kept_more_often_than_stated() {
        let mut pool = Pool::<u32>::default();
        (0..20).for_each(|value| make(&mut pool, value, &turn(value.into(), 0), &Pinned::new()));
        assert_eq!(pool.0.len(), KEPT_OF_A_PART);
        pool.drop_oldest(&Pinned::new());
        assert!(pool.get(&key(16)).is_none() && pool.get(&key(19)).is_some());
    }
}
