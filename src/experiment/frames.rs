//! Measured frames: the same frame again and again, part of it forgotten before each, the first ones not counted.

use std::collections::BTreeMap;
use std::time::Instant;

use super::ExperimentError;
use super::board::Share;
use super::lab::{Lab, pause};
use crate::engine::Engine;
use crate::settings::Settings;
use crate::spread::Spread;

/// What is made anew in every frame.
#[derive(Clone, Copy, Debug)]
pub enum Forget {
    /// All but what was uploaded.
    Everything,
    /// Light, shadow maps and pointers.
    Light,
    /// The surface image and what is made from it.
    Surfaces,
}

#[derive(Clone, Copy)]
pub struct Frames<'a> {
    /// For a person.
    pub what: &'a str,
    pub settings: &'a Settings,
    pub size_px: [u32; 2],
    pub forget: Forget,
    /// Frames that are not measured.
    pub warmup: u32,
    pub runs: u32,
}

impl Lab {
    /// Runs them; `each` is given the engine after a measured one, and its milliseconds by the clock.
    pub async fn measure(
        &mut self,
        frames: Frames<'_>,
        share: Share,
        mut each: impl FnMut(&Engine, f64),
    ) -> Result<(), ExperimentError> {
        let Frames { what, settings, size_px, forget, warmup, runs } = frames;
        for run in 0..warmup + runs {
            let share = share.part(run as usize, (warmup + runs) as usize);
            match run.checked_sub(warmup) {
                None => self.say(share, format!("{what}: warming up")),
                Some(measured) => self.say(share, format!("{what}: {} of {runs}", measured + 1)),
            }
            match forget {
                Forget::Everything => self.engine.invalidate(),
                Forget::Light => self.engine.invalidate_light(),
                Forget::Surfaces => self.engine.invalidate_surfaces(),
            }
            let started = Instant::now();
            self.run(settings, size_px, share).await?;
            let wall_ms = started.elapsed().as_secs_f64() * 1e3;
            if run >= warmup {
                each(&self.engine, wall_ms);
            }
            pause().await;
        }
        Ok(())
    }
}

/// Milliseconds of every run in which something ran, by what that is.
#[derive(Debug)]
pub struct Times<K>(BTreeMap<K, Vec<f64>>);

impl<K> Default for Times<K> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<K: Ord> Times<K> {
    /// One run: what has the same key is added up.
    pub fn add(&mut self, run: impl Iterator<Item = (K, f64)>) {
        let mut sums = BTreeMap::new();
        run.for_each(|(key, ms)| *sums.entry(key).or_insert(0.0) += ms);
        sums.into_iter().for_each(|(key, ms)| self.0.entry(key).or_default().push(ms));
    }

    /// Over the runs in which it ran.
    pub fn medians(&self) -> BTreeMap<K, f64>
    where
        K: Clone,
    {
        self.0.iter().filter_map(|(key, ms)| Some((key.clone(), Spread::of(ms)?.median_ms))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_over_the_runs_in_which_it_ran() {
        let mut times = Times::default();
        times.add([("a", 1.0), ("b", 5.0), ("a", 2.0)].into_iter());
        times.add([("a", 5.0)].into_iter());
        assert_eq!(times.medians(), BTreeMap::from([("a", 4.0), ("b", 5.0)]));
    }
}
