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

/// By method.
#[derive(Debug, Default)]
pub struct TimesBook(HashMap<Digest, Builds>);

/// Oldest first. The first build of a method may have compiled its kernels: it counts while it is alone.
#[derive(Debug, Default)]
struct Builds {
    ms: VecDeque<f64>,
    has_dropped_first: bool,
}

impl TimesBook {
    pub fn note(&mut self, method: Digest, ms: f64) {
        let builds = self.0.entry(method).or_default();
        let drops_first = builds.ms.len() == 1 && !builds.has_dropped_first;
        if drops_first || builds.ms.len() == REMEMBERED {
            builds.ms.pop_front();
            builds.has_dropped_first = true;
        }
        builds.ms.push_back(ms);
    }

    pub fn of(&self, method: Digest) -> Option<BuildTimes> {
        let times: Vec<f64> = self.0.get(&method)?.ms.iter().copied().collect();
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
        book.note(b, 1000.0);
        assert_eq!(book.of(b).map(|times| times.spread.median_ms), Some(1000.0), "better than nothing");
        [3.0, 5.0].into_iter().for_each(|ms| book.note(b, ms));
        let times = book.of(a).expect("some");
        assert_eq!((times.samples, times.spread.median_ms), (64, 167.5));
        let of_b = book.of(b).map(|times| (times.samples, times.spread.median_ms));
        assert_eq!(of_b, Some((2, 4.0)), "without the one that compiled");
        assert_eq!(book.of(Digest::default()), None);
    }
}
