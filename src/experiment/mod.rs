//! What kernels cost, and what moved voxels, their light and cones get wrong: measurements that take long, on an engine
//! of their own.
//!
//! ```text
//! Subject ─► Experiment ──advance(budget)──► Working, … ─► Report: rows, tables, JSON
//!               └─► Engine over a shared Gpu, threads for work of the CPU
//! ```
//!
//! An experiment is written as a procedure that pauses after every slice: an `async fn`, which the compiler turns into
//! a state machine. Nothing runs it but [`Experiment::advance`]; there is no executor. Times belong to the passes of its
//! own frames, so several experiments and a window may share one GPU.

mod accuracy;
pub mod bench;
mod board;
mod cost;
mod error;
mod exact;
mod frames;
mod lab;
mod report;
mod rows;
mod subject;
mod surface_work;
mod table;

use std::pin::Pin;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use crate::gpu::{Gpu, GpuError};

pub use accuracy::rendering::{RenderingOptions, rendering};
pub use accuracy::shadows::shadows;
pub use accuracy::traced::{Traced, traced};
pub use accuracy::voxels::voxels;
pub use bench::discretizers::discretizers;
pub use bench::{BenchOptions, bench};
pub use board::{NamedPicture, Remark};
pub use cost::Cost;
pub use error::{ExperimentError, TraceError};
pub use report::{Found, Report};
pub use rows::{
    DiscretizerReport, DiscretizerRow, KernelReport, LightReport, RenderingRow, ShadowRow, SurfaceReport, VoxelRow,
    paths_in_that_time,
};
pub use subject::Subject;
pub use surface_work::SurfaceWork;
pub use table::Table;

use board::{Board, Findings};
use lab::Lab;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    Working,
    /// All rows are there.
    Finished,
    /// By a person, or by an error; the rows that were finished are there.
    Cancelled,
}

type Procedure = Pin<Box<dyn Future<Output = Result<(), ExperimentError>>>>;

/// A measurement on its way. Dropping it cancels it.
pub struct Experiment {
    gpu: Arc<Gpu>,
    board: Rc<Board>,
    /// Owns the engine; `None` once it has ended.
    procedure: Option<Procedure>,
    state: State,
    /// Without its rows.
    head: Report,
    found: Box<dyn Fn() -> Found>,
}

impl Experiment {
    /// `rows`: none so far. The procedure adds to them.
    fn begin<R: Clone + Into<Found> + 'static>(
        gpu: &Arc<Gpu>,
        (name, subject): (&'static str, Subject),
        rows: R,
        procedure: impl AsyncFnOnce(Lab, Rc<Findings<R>>) -> Result<(), ExperimentError> + 'static,
    ) -> Self {
        let head = Report::new(name, &gpu.info, &subject.settings, rows.clone().into());
        let board = Rc::new(Board::default());
        let rows = Rc::new(Findings::new(rows, Rc::clone(&board)));
        let lab = Lab::new(Arc::clone(gpu), subject, Rc::clone(&board));
        let shared = Rc::clone(&rows);
        Self {
            gpu: Arc::clone(gpu),
            board,
            procedure: Some(Box::pin(async move { procedure(lab, shared).await })),
            state: State::Working,
            head,
            found: Box::new(move || rows.borrow().clone().into()),
        }
    }

    /// Works on it for about `budget` of GPU time; blocks at most for what the GPU has already begun. An error ends it
    /// and is told once; the rows that were finished stay.
    pub fn advance(&mut self, budget: Duration) -> Result<State, ExperimentError> {
        let Some(procedure) = &mut self.procedure else { return Ok(self.state) };
        self.board.budget.set(budget);
        if let Poll::Ready(outcome) = procedure.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            self.procedure = None;
            self.state = if outcome.is_ok() { State::Finished } else { State::Cancelled };
            outcome?;
        }
        Ok(self.state)
    }

    /// Blocks until there is something to advance: for who has nothing else to do.
    pub fn wait(&self) -> Result<(), GpuError> {
        if self.board.waits_for_thread.get() {
            // A thread that ends wakes this one; its progress does not.
            std::thread::park_timeout(Duration::from_millis(50));
            return Ok(());
        }
        self.gpu.wait()
    }

    /// Ends it, and drops its engine; the rows that are finished stay.
    pub fn cancel(&mut self) {
        if self.procedure.take().is_some() {
            self.state = State::Cancelled;
        }
    }

    pub fn state(&self) -> State {
        self.state
    }

    /// The part that is done, 0 to 1.
    pub fn fraction(&self) -> f32 {
        self.board.fraction.get()
    }

    /// What is being done, a short sentence.
    pub fn doing(&self) -> String {
        self.board.doing.borrow().clone()
    }

    /// What was to be told since the last call.
    pub fn take_remarks(&self) -> Vec<Remark> {
        self.board.remarks.take()
    }

    /// What was drawn since the last call.
    pub fn take_pictures(&self) -> Vec<NamedPicture> {
        self.board.pictures.take()
    }

    /// Grows with every change of what was found.
    pub fn changes(&self) -> u64 {
        self.board.changes.get()
    }

    /// What was found so far.
    pub fn report(&self) -> Report {
        let cancelled = self.state == State::Cancelled;
        Report { cancelled, found: (self.found)(), ..self.head.clone() }
    }
}
