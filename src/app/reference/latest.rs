//! The newest result of work that is asked for again and again: one thread at a time, what is no longer asked
//! for is let go when it is done.

use crate::app::background::{Background, Outcome};

/// `K`: what a result is of.
pub struct Latest<K, T> {
    running: Option<(K, Background<T>)>,
    done: Option<(K, T)>,
    /// What the last work ended without a result of.
    died: Option<K>,
}

impl<K, T> Default for Latest<K, T> {
    fn default() -> Self {
        Self { running: None, done: None, died: None }
    }
}

impl<K: PartialEq, T: Send + 'static> Latest<K, T> {
    /// Takes what is done; whether there is something new.
    pub fn collect(&mut self) -> bool {
        let Some((key, work)) = self.running.take() else { return false };
        match work.poll() {
            Outcome::Running => self.running = Some((key, work)),
            Outcome::Done(result) => self.done = Some((key, result)),
            Outcome::Died => self.died = Some(key),
        }
        self.running.is_none()
    }

    /// Whether work on this is to be started: nothing is under way, and it is not done.
    pub fn wants(&self, key: &K) -> bool {
        let is_done = self.done.as_ref().is_some_and(|(done, _)| done == key);
        self.running.is_none() && !is_done && self.died.as_ref() != Some(key)
    }

    pub fn start(&mut self, key: K, work: Background<T>) {
        self.running = Some((key, work));
    }

    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// The last result, and what it is of.
    pub fn get(&self) -> Option<&(K, T)> {
        self.done.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn collect(latest: &mut Latest<u32, u32>) {
        while !latest.collect() {
            std::thread::yield_now();
        }
    }

    #[test]
    fn the_newest_result_stays_until_the_next_is_done() {
        let ctx = egui::Context::default();
        let mut latest = Latest::<u32, u32>::default();
        assert!(latest.wants(&1) && !latest.collect());
        latest.start(1, Background::start(&ctx, |_| 10));
        assert!(!latest.wants(&2), "one at a time");
        collect(&mut latest);
        assert!(latest.get() == Some(&(1, 10)) && !latest.wants(&1) && latest.wants(&2));
        latest.start(2, Background::start(&ctx, |_| std::panic::resume_unwind(Box::new(()))));
        assert_eq!(latest.get(), Some(&(1, 10)));
        collect(&mut latest);
        assert!(latest.get() == Some(&(1, 10)) && !latest.wants(&2), "what has failed is not tried again");
    }
}
