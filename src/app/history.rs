//! What the last frames of the engine cost, for the plot.

use std::collections::{BTreeMap, VecDeque};

use crate::engine::PassTiming;
use crate::gpu::KernelTiming;

/// Frames kept.
pub const LENGTH: usize = 120;

#[derive(Default)]
pub struct FrameHistory {
    gpu_ms: VecDeque<f64>,
}

impl FrameHistory {
    /// Adds a frame: of all results that are there, the times of those it made itself.
    pub fn push(&mut self, timings: &[PassTiming], frame: u64) {
        if self.gpu_ms.len() == LENGTH {
            self.gpu_ms.pop_front();
        }
        let own = timings.iter().filter(|timing| timing.frame == frame);
        self.gpu_ms.push_back(own.map(|timing| timing.kernel.ms).sum());
    }

    /// GPU milliseconds of each frame, oldest first.
    pub fn gpu_ms(&self) -> impl ExactSizeIterator<Item = f64> {
        self.gpu_ms.iter().copied()
    }
}

/// A kernel's runs, added up.
#[derive(Clone, Debug)]
pub struct KernelSum {
    pub timing: KernelTiming,
    /// The last frame that ran it.
    pub frame: u64,
}

pub fn total_ms(timings: &[PassTiming]) -> f64 {
    timings.iter().map(|timing| timing.kernel.ms).sum()
}

/// Passes of one kernel added up, in order of their first run.
pub fn by_kernel(timings: &[PassTiming]) -> Vec<KernelSum> {
    let mut places = BTreeMap::new();
    let mut kernels: Vec<KernelSum> = Vec::new();
    for PassTiming { frame, kernel, .. } in timings {
        let place = *places.entry(kernel.kernel.as_str()).or_insert(kernels.len());
        match kernels.get_mut(place) {
            Some(sum) => {
                sum.timing.ms += kernel.ms;
                sum.timing.bytes_moved += kernel.bytes_moved;
                sum.timing.threads += kernel.threads;
                sum.frame = sum.frame.max(*frame);
            }
            None => kernels.push(KernelSum { timing: kernel.clone(), frame: *frame }),
        }
    }
    kernels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Pass;

    fn timing(kernel: &str, ms: f64, frame: u64) -> PassTiming {
        let kernel = KernelTiming { kernel: kernel.to_owned(), ms, bytes_moved: 4, threads: 1, group: 0 };
        PassTiming { pass: Pass::MarkLeaves, frame, kernel }
    }

    #[test]
    fn passes_of_a_kernel_are_added_up_in_frame_order() {
        let timings = [timing("b", 1.0, 1), timing("a", 2.0, 1), timing("b", 3.0, 2)];
        let kernels = by_kernel(&timings);
        assert_eq!(kernels.len(), 2);
        let first = &kernels[0].timing;
        assert_eq!((first.kernel.as_str(), first.ms, first.bytes_moved, kernels[0].frame), ("b", 4.0, 8, 2));
        assert_eq!(total_ms(&timings), 6.0);
    }

    #[test]
    fn old_frames_are_forgotten() {
        let mut history = FrameHistory::default();
        (0..=LENGTH as u64).for_each(|frame| history.push(&[timing("build/mark", frame as f64, frame)], frame));
        assert_eq!(history.gpu_ms().len(), LENGTH);
        assert_eq!(history.gpu_ms().next(), Some(1.0));
    }

    #[test]
    fn a_frame_of_the_view_alone_counts_the_view_alone() {
        let built = [timing("clear leaf bits", 1.0, 1), timing("build/mark", 2.0, 1)];
        let mut history = FrameHistory::default();
        history.push(&[&built[..], &[timing("view/march", 4.0, 1)]].concat(), 1);
        history.push(&[&built[..], &[timing("view/march", 4.0, 2)]].concat(), 2);
        assert_eq!(history.gpu_ms().collect::<Vec<_>>(), [7.0, 4.0]);
    }
}
