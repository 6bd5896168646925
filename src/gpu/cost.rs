//! What a kernel costs: measured times, and the guess that cuts its next run into slices.

use std::time::Duration;

/// Before anything is measured: the first range fills the 30 ms that a slice usually has.
const FIRST_GUESS_NS_PER_THREAD: f64 = 30e6 / FIRST_RANGE_THREADS as f64;
/// How many threads the running average remembers. Weighting by threads keeps tiny dispatches,
/// which are all overhead, from spoiling it.
const MEMORY_THREADS: f64 = (1 << 20) as f64;
/// A range has at most this many threads, and at most [`GROWTH`] times those of the largest range
/// measured: what a wrong estimate can cost.
const MAX_RANGE_THREADS: u64 = 1 << 22;
const FIRST_RANGE_THREADS: u64 = 1 << 18;
const GROWTH: u64 = 8;
/// Start of any dispatch, whatever its size.
pub(super) const PASS_NS: f64 = 20e3;

/// Time of one recorded pass; its slices added up.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelTiming {
    /// As begun when recording, see [`super::Recorder::begin`].
    pub group: u32,
    /// Kernel name, or "clear LABEL" and "copy LABEL".
    pub kernel: String,
    pub ms: f64,
    /// Reads and writes that the algorithm needs: as declared when recording, or counted.
    pub bytes_moved: u64,
    pub threads: u64,
}

/// Running average of nanoseconds a thread.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    ns: f64,
    threads: f64,
    largest_range: u64,
}

impl Cost {
    pub fn ns_per_thread(&self) -> f64 {
        if self.is_measured() { self.ns / self.threads } else { FIRST_GUESS_NS_PER_THREAD }
    }

    pub fn is_measured(&self) -> bool {
        self.threads > 0.0
    }

    pub fn max_threads(&self) -> u64 {
        (GROWTH * self.largest_range).clamp(FIRST_RANGE_THREADS, MAX_RANGE_THREADS)
    }

    pub fn learn(&mut self, took: Duration, threads: u64) {
        let forget = (MEMORY_THREADS / (self.threads + threads as f64)).min(1.0);
        self.ns = self.ns * forget + (took.as_nanos() as f64 - PASS_NS).max(0.0);
        self.threads = self.threads * forget + threads as f64;
        self.largest_range = self.largest_range.max(threads);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_tiny_dispatches_do_not_spoil_the_average() {
        let mut cost = Cost::default();
        cost.learn(Duration::from_millis(10), 1 << 20);
        let before = cost.ns_per_thread();
        (0..100).for_each(|_| cost.learn(Duration::from_micros(60), 8));
        assert!(cost.ns_per_thread() < 1.5 * before);
    }

    #[test]
    fn a_changed_cost_is_learnt_from_one_large_dispatch() {
        let mut cost = Cost::default();
        cost.learn(Duration::from_millis(1), 1 << 20);
        cost.learn(Duration::from_millis(100), 1 << 22);
        assert!(cost.ns_per_thread() > 0.5 * 100e6 / f64::from(1 << 22));
    }
}
