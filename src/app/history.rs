//! What the last frames of the engine cost, for the plot.

use std::collections::{BTreeMap, VecDeque};

use crate::gpu::KernelTiming;

/// Frames kept.
pub const LENGTH: usize = 120;

#[derive(Default)]
pub struct FrameHistory {
    gpu_ms: VecDeque<f64>,
}

impl FrameHistory {
    pub fn push(&mut self, timings: &[KernelTiming]) {
        if self.gpu_ms.len() == LENGTH {
            self.gpu_ms.pop_front();
        }
        self.gpu_ms.push_back(total_ms(timings));
    }

    /// GPU milliseconds of each frame, oldest first.
    pub fn gpu_ms(&self) -> impl ExactSizeIterator<Item = f64> {
        self.gpu_ms.iter().copied()
    }
}

pub fn total_ms(timings: &[KernelTiming]) -> f64 {
    timings.iter().map(|timing| timing.ms).sum()
}

/// Passes of one kernel added up, in order of their first run.
pub fn by_kernel(timings: &[KernelTiming]) -> Vec<KernelTiming> {
    let mut places = BTreeMap::new();
    let mut kernels: Vec<KernelTiming> = Vec::new();
    for timing in timings {
        let place = *places.entry(timing.kernel.as_str()).or_insert(kernels.len());
        match kernels.get_mut(place) {
            Some(sum) => {
                sum.ms += timing.ms;
                sum.bytes_moved += timing.bytes_moved;
                sum.threads += timing.threads;
            }
            None => kernels.push(timing.clone()),
        }
    }
    kernels
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timing(kernel: &str, ms: f64) -> KernelTiming {
        KernelTiming { kernel: kernel.to_owned(), ms, bytes_moved: 4, threads: 1 }
    }

    #[test]
    fn passes_of_a_kernel_are_added_up_in_frame_order() {
        let timings = [timing("b", 1.0), timing("a", 2.0), timing("b", 3.0)];
        let kernels = by_kernel(&timings);
        assert_eq!(kernels.len(), 2);
        assert_eq!((kernels[0].kernel.as_str(), kernels[0].ms, kernels[0].bytes_moved), ("b", 4.0, 8));
        assert_eq!(total_ms(&timings), 6.0);
    }

    #[test]
    fn old_frames_are_forgotten() {
        let mut history = FrameHistory::default();
        (0..LENGTH + 1).for_each(|frame| history.push(&[timing("a", frame as f64)]));
        assert_eq!(history.gpu_ms().len(), LENGTH);
        assert_eq!(history.gpu_ms().next(), Some(1.0));
    }
}
