//! Runs recorded commands in slices, so that nothing else on the queue waits long.
//!
//! A pass is cut into ranges of threads by what a thread of its kernel was measured to cost; a
//! range starts at a whole workgroup, so workgroups hold the same threads however it is cut. One
//! slice is on the queue at a time. Times come from timestamps where the device has them (one
//! profiler frame a slice), else from the clock, shared out by the estimate. What is wanted back is copied
//! at the end of the last slice.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use super::cost::{KernelTiming, PASS_NS};
use super::lock::lock;
use super::read_back::ReadBack;
use super::recorder::{Command, Recorder};
use super::scratch::{MAX_PIECES, Piece, Scratch};
use super::{Gpu, GpuBuffer, GpuError, counts, encode};

/// A cut shorter than this part of the budget is not worth a submission's place.
const MIN_PART_OF_BUDGET: f64 = 0.1;
/// Below the two seconds after which drivers give a GPU up, with room for wrong guesses.
const UNWATCHED_BUDGET: Duration = Duration::from_millis(200);

/// Drivers compile a kernel when it runs first, and the queue may stand still for seconds. Calls that submit nothing
/// before that: a window sees after the first that there is work, and shows it before the second.
const CALLS_BEFORE_FIRST_RUN: u32 = 2;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JobState {
    /// The part of all commands that is submitted, 0 to 1.
    Running { submitted: f32 },
    /// All is submitted and finished, and what was wanted back is here.
    Done,
}

/// A recording on its way through the queue. Dropping it leaves the rest undone.
pub struct Job {
    recorder: Recorder,
    /// First command that is not submitted completely, and how many of its units are.
    command: usize,
    unit: u64,
    /// Calls that still submit nothing.
    held_back: u32,
    slice: Option<Slice>,
    scratch: Option<Scratch>,
    timings: Vec<KernelTiming>,
    /// The recording's reads, then what its passes are counted by.
    wanted_back: Vec<(GpuBuffer, Range<u64>)>,
    read_back: Option<ReadBack>,
    reads: Vec<Vec<u8>>,
    done: bool,
}

/// What is on the queue now.
struct Slice {
    pieces: Vec<Piece>,
    /// Nanoseconds from `submitted` to the end; 0 while it runs.
    took_ns: Arc<AtomicU64>,
}

impl fmt::Debug for Job {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (command, commands) = (self.command, self.recorder.commands.len());
        formatter.debug_struct("Job").field("command", &command).field("commands", &commands).finish_non_exhaustive()
    }
}

impl Job {
    pub fn new(recorder: Recorder) -> Self {
        let commands = recorder.commands.iter().zip(&recorder.groups);
        let timings = commands.map(|(command, group)| command.timing(*group)).collect();
        let is_new =
            |command: &Command| command.shape().0 > 0 && command.cost().is_some_and(|cost| !lock(cost).is_measured());
        let held_back = if recorder.commands.iter().any(is_new) { CALLS_BEFORE_FIRST_RUN } else { 0 };
        let counted = counts::buffers(&recorder.commands);
        let wanted_back = recorder.reads.iter().cloned().chain(counted).collect();
        Self {
            recorder,
            command: 0,
            unit: 0,
            held_back,
            slice: None,
            scratch: None,
            timings,
            wanted_back,
            read_back: None,
            reads: Vec::new(),
            done: false,
        }
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
        if self.held_back > 0 {
            self.held_back -= 1;
            return Ok(self.running());
        }
        let pieces = self.take_pieces(budget);
        let reads_now = self.is_cut_up() && self.read_back.is_none() && !self.wanted_back.is_empty();
        if !pieces.is_empty() || reads_now {
            self.submit(gpu, pieces)?;
            return Ok(self.running());
        }
        if !self.received(gpu)? {
            return Ok(self.running());
        }
        self.finish(gpu);
        Ok(JobState::Done)
    }

    /// Runs everything and waits for it; returns the times, in order of recording.
    pub fn run_to_end(mut self, gpu: &Gpu) -> Result<Vec<KernelTiming>, GpuError> {
        while self.advance(gpu, UNWATCHED_BUDGET)? != JobState::Done {
            gpu.wait()?;
        }
        Ok(self.take_timings())
    }

    /// Times of all commands in order of recording, once the job is done; none a second time.
    pub fn take_timings(&mut self) -> Vec<KernelTiming> {
        if self.done { std::mem::take(&mut self.timings) } else { Vec::new() }
    }

    /// What [`Recorder::read`] asked for, by number, once the job is done; nothing a second time.
    pub fn take_reads(&mut self) -> Vec<Vec<u8>> {
        std::mem::take(&mut self.reads)
    }

    /// Whether every command is submitted.
    fn is_cut_up(&self) -> bool {
        self.command >= self.recorder.commands.len()
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
            None => Scratch::take(gpu, &gpu.scratch, &self.recorder.uniforms)?,
        };
        let reads = if self.is_cut_up() { &*self.wanted_back } else { &[] };
        let (took_ns, read_back) = encode::submit(gpu, &self.recorder.commands, &pieces, reads, &mut scratch)?;
        for piece in pieces.iter().filter(|piece| piece.first == 0) {
            let command = &self.recorder.commands[piece.command];
            if matches!(command, Command::Pass(_) | Command::Raster { .. }) {
                gpu.counted(|counters| *counters.dispatches.entry(command.name()).or_default() += 1);
            }
        }
        self.scratch = Some(scratch);
        self.slice = Some(Slice { pieces, took_ns });
        self.read_back = read_back;
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

    /// Whether all that is wanted back is here; takes it down.
    fn received(&mut self, gpu: &Gpu) -> Result<bool, GpuError> {
        let Some(read_back) = &self.read_back else { return Ok(true) };
        let Some(mut bytes) = read_back.take(gpu)? else { return Ok(false) };
        let counted = bytes.split_off(self.recorder.reads.len());
        counts::put_down(&self.recorder.commands, &counted, &mut self.timings);
        self.reads = bytes;
        Ok(true)
    }

    fn finish(&mut self, gpu: &Gpu) {
        lock(&gpu.scratch).extend(self.scratch.take());
        self.done = true;
    }
}
