//! What the last frames of the engine cost, for the plot.

use std::collections::{BTreeMap, VecDeque};

use crate::gpu::KernelTiming;
use crate::plan::{FramePlan, Pass, Row, State};

/// Frames kept.
pub const LENGTH: usize = 120;

#[derive(Default)]
pub struct FrameHistory {
    gpu_ms: VecDeque<f64>,
}

impl FrameHistory {
    /// Adds a frame: of all results that are there, the times of those it made itself.
    pub fn push(&mut self, timings: &[KernelTiming], plan: &FramePlan) {
        if self.gpu_ms.len() == LENGTH {
            self.gpu_ms.pop_front();
        }
        self.gpu_ms.push_back(timings.iter().filter(|timing| has_run(timing, plan)).map(|timing| timing.ms).sum());
    }

    /// GPU milliseconds of each frame, oldest first.
    pub fn gpu_ms(&self) -> impl ExactSizeIterator<Item = f64> {
        self.gpu_ms.iter().copied()
    }
}

/// Whether a frame of this plan ran the kernel itself. Clears and copies belong to the build.
pub fn has_run(timing: &KernelTiming, plan: &FramePlan) -> bool {
    let of_pass = |row: &Row| row.pass.kernels().contains(&timing.kernel.as_str());
    let mut passes = plan.rows.iter().filter(|row| of_pass(row)).peekable();
    if passes.peek().is_none() {
        return plan.runs(Pass::MarkLeaves);
    }
    passes.any(|row| row.state == State::Run)
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
        KernelTiming { group: 0, kernel: kernel.to_owned(), ms, bytes_moved: 4, threads: 1 }
    }

    #[test]
    fn passes_of_a_kernel_are_added_up_in_frame_order() {
        let timings = [timing("b", 1.0), timing("a", 2.0), timing("b", 3.0)];
        let kernels = by_kernel(&timings);
        assert_eq!(kernels.len(), 2);
        assert_eq!((kernels[0].kernel.as_str(), kernels[0].ms, kernels[0].bytes_moved), ("b", 4.0, 8));
        assert_eq!(total_ms(&timings), 6.0);
    }

    fn plan(run: &[Pass]) -> FramePlan {
        let state = |pass: &Pass| if run.contains(pass) { State::Run } else { State::Reuse };
        FramePlan { rows: Pass::ALL.iter().map(|pass| Row { pass: *pass, state: state(pass), reason: "" }).collect() }
    }

    #[test]
    fn old_frames_are_forgotten() {
        let mut history = FrameHistory::default();
        (0..LENGTH + 1)
            .for_each(|frame| history.push(&[timing("build/mark", frame as f64)], &plan(&[Pass::MarkLeaves])));
        assert_eq!(history.gpu_ms().len(), LENGTH);
        assert_eq!(history.gpu_ms().next(), Some(1.0));
    }

    #[test]
    fn a_frame_of_the_view_alone_counts_the_view_alone() {
        let timings = [timing("clear leaf bits", 1.0), timing("build/mark", 2.0), timing("view/march", 4.0)];
        let mut history = FrameHistory::default();
        history.push(&timings, &plan(&[Pass::MarkLeaves, Pass::MarchVoxels]));
        history.push(&timings, &plan(&[Pass::MarchVoxels]));
        assert_eq!(history.gpu_ms().collect::<Vec<_>>(), [7.0, 4.0]);
    }
}
