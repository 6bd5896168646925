//! What kernels took: of a pass of a frame, out of the job that ran it; and of whole builds the last few.

use std::collections::{HashMap, VecDeque};

use serde::Serialize;

use crate::digest::Digest;
use crate::gpu::KernelTiming;
use crate::plan::Pass;
use crate::spread::Spread;

/// Builds that a median is taken over.
const REMEMBERED: usize = 64;

/// One kernel of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    pub pass: Pass,
    /// The frame that ran it.
    pub frame: u64,
    pub kernel: KernelTiming,
}

/// Milliseconds of the last builds by one method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BuildTimes {
    #[serde(flatten)]
    pub spread: Spread,
    pub samples: usize,
}

/// By method, oldest first.
#[derive(Debug, Default)]
pub struct TimesBook(HashMap<Digest, VecDeque<f64>>);

impl TimesBook {
    pub fn note(&mut self, method: Digest, ms: f64) {
        let times = self.0.entry(method).or_default();
        if times.len() == REMEMBERED {
            times.pop_front();
        }
        times.push_back(ms);
    }

    pub fn of(&self, method: Digest) -> Option<BuildTimes> {
        let times: Vec<f64> = self.0.get(&method)?.iter().copied().collect();
        Some(BuildTimes { spread: Spread::of(&times)?, samples: times.len() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_builds_of_a_method_count() {
        let mut book = TimesBook::default();
        let [a, b] = [1, 2].map(|method: u32| Digest::of(&method));
        (0..200).for_each(|ms| book.note(a, f64::from(ms)));
        book.note(b, 1.0);
        let times = book.of(a).expect("some");
        assert_eq!((times.samples, times.spread.median_ms), (64, 167.5));
        assert_eq!(book.of(b).map(|times| times.samples), Some(1));
        assert_eq!(book.of(Digest::default()), None);
    }
}
