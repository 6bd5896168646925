//! Runs recorded commands in slices, so that nothing else on the queue waits long.
//!
//! A pass is cut into ranges of threads by what a thread of its kernel was measured to cost; a
//! range starts at a whole workgroup, so workgroups hold the same threads however it is cut. One
//! slice is on the queue at a time. Times come from timestamps where the device has them (one
//! profiler frame a slice), else from the clock, shared out by the estimate.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::cost::{Cost, KernelTiming, PASS_NS};
use super::encode::{self, MAX_PIECES, Piece, Scratch};
use super::recorder::{Command, Recorder};
use super::{Gpu, GpuError, lock};

/// Clearing and copying, cautiously.
const NS_PER_BYTE: f64 = 0.25;
/// A cut shorter than this part of the budget is not worth a submission's place.
const MIN_PART_OF_BUDGET: f64 = 0.1;
/// Below the two seconds after which drivers give a GPU up, with room for wrong guesses.
const UNWATCHED_BUDGET: Duration = Duration::from_millis(200);

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JobState {
    /// The part of all commands that is submitted, 0 to 1.
    Running { submitted: f32 },
    /// All is submitted and finished.
    Done,
}

/// A recording on its way through the queue. Dropping it leaves the rest undone.
pub struct Job {
    recorder: Recorder,
    /// First command that is not submitted completely, and how many of its units are.
    command: usize,
    unit: u64,
    slice: Option<Slice>,
    scratch: Option<Scratch>,
    timings: Vec<KernelTiming>,
    done: bool,
}

/// What is on the queue now.
struct Slice {
    pieces: Vec<Piece>,
    /// Nanoseconds from `submitted` to the end; 0 while it runs.
    took_ns: Arc<AtomicU64>,
}

impl Job {
    pub fn new(recorder: Recorder) -> Self {
        let timings = recorder.commands.iter().map(Command::timing).collect();
        Self { recorder, command: 0, unit: 0, slice: None, scratch: None, timings, done: false }
    }

    /// Submits about `budget` of GPU time if the previous slice has finished; never blocks. Call
    /// until [`JobState::Done`]. After an error the job is over.
    pub fn advance(&mut self, gpu: &Gpu, budget: Duration) -> Result<JobState, GpuError> {
        if self.done {
            return Ok(JobState::Done);
        }
        if let Some(error) = &self.recorder.error {
            return Err(error.clone());
        }
        gpu.poll()?;
        if !self.slice_finished(gpu) {
            return Ok(self.running());
        }
        let pieces = self.take_pieces(budget);
        if pieces.is_empty() {
            self.finish(gpu);
            return Ok(JobState::Done);
        }
        self.submit(gpu, pieces)?;
        Ok(self.running())
    }

    /// Runs everything and waits for it.
    pub fn run_to_end(mut self, gpu: &Gpu) -> Result<(), GpuError> {
        while self.advance(gpu, UNWATCHED_BUDGET)? != JobState::Done {
            gpu.wait()?;
        }
        Ok(())
    }

    fn running(&self) -> JobState {
        JobState::Running { submitted: self.command as f32 / self.recorder.commands.len().max(1) as f32 }
    }

    /// Cuts the next pieces off the commands until the budget is full; at least one
    /// while there is work.
    fn take_pieces(&mut self, budget: Duration) -> Vec<Piece> {
        let budget_ns = budget.as_nanos() as f64;
        let mut left_ns = budget_ns;
        let mut pieces = Vec::new();
        while let Some(command) = self.recorder.commands.get(self.command)
            && pieces.len() < MAX_PIECES
        {
            let (units, ns_per_unit, step) = command.shape();
            if units == 0 {
                self.command += 1;
                continue;
            }
            let rest = units - self.unit;
            let fits = (((left_ns - PASS_NS) / ns_per_unit) as u64).min(command.max_units());
            if fits < rest && !pieces.is_empty() && (left_ns - PASS_NS) < MIN_PART_OF_BUDGET * budget_ns {
                break;
            }
            let taken = if fits >= rest { rest } else { (fits / step).max(1) * step }.min(rest);
            let estimated_ns = PASS_NS + taken as f64 * ns_per_unit;
            pieces.push(Piece { command: self.command, first: self.unit, end: self.unit + taken, estimated_ns });
            left_ns -= estimated_ns;
            self.unit += taken;
            if self.unit == units {
                (self.command, self.unit) = (self.command + 1, 0);
            }
        }
        pieces
    }

    fn submit(&mut self, gpu: &Gpu, pieces: Vec<Piece>) -> Result<(), GpuError> {
        let mut scratch = match self.scratch.take() {
            Some(scratch) => scratch,
            None => Scratch::take(gpu, &self.recorder.uniforms)?,
        };
        let took_ns = encode::submit(gpu, &self.recorder.commands, &pieces, &mut scratch)?;
        for piece in pieces.iter().filter(|piece| piece.first == 0) {
            let command = &self.recorder.commands[piece.command];
            if matches!(command, Command::Pass(_) | Command::Raster { .. }) {
                gpu.counted(|counters| *counters.dispatches.entry(command.name()).or_default() += 1);
            }
        }
        self.scratch = Some(scratch);
        self.slice = Some(Slice { pieces, took_ns });
        Ok(())
    }

    /// Whether nothing is on the queue; takes down the times of what has just finished.
    fn slice_finished(&mut self, gpu: &Gpu) -> bool {
        let (Some(slice), Some(scratch)) = (&self.slice, &mut self.scratch) else { return true };
        let took_ns = slice.took_ns.load(Ordering::Acquire);
        if took_ns == 0 {
            return false;
        }
        let stamps = match &mut scratch.profiler {
            Some(profiler) => match profiler.process_finished_frame(gpu.queue.get_timestamp_period()) {
                Some(stamps) => stamps,
                None => return false,
            },
            None => Vec::new(),
        };
        let estimated_ns: f64 = slice.pieces.iter().map(|piece| piece.estimated_ns).sum();
        for (index, piece) in slice.pieces.iter().enumerate() {
            let stamped = stamps.get(index).and_then(|stamp| stamp.time.clone());
            let shared = took_ns as f64 * 1e-9 * piece.estimated_ns / estimated_ns;
            let seconds = stamped.map_or(shared, |time| (time.end - time.start).max(0.0));
            self.timings[piece.command].ms += seconds * 1e3;
            if let Some(cost) = self.recorder.commands[piece.command].cost() {
                lock(cost).learn(Duration::from_secs_f64(seconds), piece.end - piece.first);
            }
        }
        self.slice = None;
        true
    }

    fn finish(&mut self, gpu: &Gpu) {
        lock(&gpu.timings).append(&mut self.timings);
        lock(&gpu.scratch).extend(self.scratch.take());
        self.done = true;
    }
}

impl Command {
    /// Units of work, what one costs, and what their number in a cut is a multiple of.
    fn shape(&self) -> (u64, f64, u64) {
        match self {
            Self::Pass(pass) => {
                let ns_per_thread = lock(&pass.kernel.cost).ns_per_thread();
                // A range that a kernel knows nothing of cannot be cut.
                let step = if pass.kernel.ranged { u64::from(pass.kernel.workgroup_size[0]) } else { u64::MAX };
                (u64::from(pass.threads), ns_per_thread, step)
            }
            Self::Raster { draws, .. } => {
                let vertices: u64 = draws.iter().map(|draw| u64::from(draw.vertices)).sum();
                let ns_per_vertex = draws.first().map_or(0.0, |draw| lock(&draw.kernel.cost).ns_per_thread());
                // Without draws there is still the clearing.
                (vertices.max(1), ns_per_vertex, 3)
            }
            Self::Clear { buffer } => (buffer.bytes(), NS_PER_BYTE, 4),
            Self::Copy { bytes, .. } => (*bytes, NS_PER_BYTE, 4),
        }
    }

    fn max_units(&self) -> u64 {
        self.cost().map_or(u64::MAX, |cost| lock(cost).max_threads())
    }

    /// Where its measured times go.
    fn cost(&self) -> Option<&Mutex<Cost>> {
        match self {
            Self::Pass(pass) => Some(&pass.kernel.cost),
            Self::Raster { draws, .. } => draws.first().map(|draw| &draw.kernel.cost),
            Self::Clear { .. } | Self::Copy { .. } => None,
        }
    }

    /// What counters and timings call it.
    fn name(&self) -> String {
        match self {
            Self::Pass(pass) => pass.kernel.name.clone(),
            Self::Raster { draws, .. } => {
                draws.first().map_or("clear picture".to_owned(), |draw| draw.kernel.name.clone())
            }
            Self::Clear { buffer } => format!("clear {}", buffer.label()),
            Self::Copy { from, .. } => format!("copy {}", from.label()),
        }
    }

    fn timing(&self) -> KernelTiming {
        let (bytes_moved, threads) = match self {
            Self::Pass(pass) => (pass.bytes_moved, u64::from(pass.threads)),
            Self::Raster { draws, .. } => (0, draws.iter().map(|draw| u64::from(draw.vertices)).sum()),
            Self::Clear { buffer } => (buffer.bytes(), 0),
            Self::Copy { bytes, .. } => (2 * bytes, 0),
        };
        KernelTiming { kernel: self.name(), ms: 0.0, bytes_moved, threads }
    }
}
