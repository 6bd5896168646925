//! Where a procedure works: its engine, and the words it waits by. Whatever takes long pauses in between.

use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{TryRecvError, channel};
use std::task::Poll;
use std::thread;

use super::board::{Board, NamedPicture, Remark, Share};
use super::{ExperimentError, Subject};
use crate::engine::{Engine, EngineState};
use crate::gpu::{Gpu, Job, JobState, KernelTiming};
use crate::prepare::Prepared;
use crate::progress::Progress;
use crate::settings::Settings;

/// Picture size where nothing is looked at.
pub const NO_PICTURE: [u32; 2] = [1, 1];

/// As the window's picture, for kernels that draw.
pub const PICTURE_PX: [u32; 2] = [1280, 720];

/// Frames before those that are measured, where nothing else is asked for.
const WARMUP: u32 = 1;

pub struct Lab {
    pub engine: Engine,
    pub prepared: Arc<Prepared>,
    /// As the subject has them.
    pub settings: Settings,
    /// Frames before those that are measured.
    pub warmup: u32,
    pub runs: u32,
    board: Rc<Board>,
    warned: Vec<String>,
}

impl Lab {
    pub fn new(gpu: Arc<Gpu>, subject: Subject, board: Rc<Board>) -> Self {
        let Subject { prepared, settings, runs } = subject;
        let mut engine = Engine::new(gpu);
        engine.set_prepared(Some(Arc::clone(&prepared)));
        Self { engine, prepared, settings, warmup: WARMUP, runs, board, warned: Vec::new() }
    }

    /// Says what is done, from the beginning of its share on.
    pub fn say(&self, share: Share, doing: impl Into<String>) {
        self.board.reach(share, 0.0);
        self.board.doing.replace(doing.into());
    }

    /// Each sentence once.
    pub fn warn(&mut self, sentences: &[String]) {
        for sentence in sentences {
            if !self.warned.contains(sentence) {
                self.warned.push(sentence.clone());
                self.board.remarks.borrow_mut().push(Remark::Warning(sentence.clone()));
            }
        }
    }

    /// A row that is left out.
    pub fn miss(&self, what: &str, error: &ExperimentError) {
        self.board.remarks.borrow_mut().push(Remark::Missing(format!("{what} is not measured: {error}")));
    }

    pub fn show(&self, picture: NamedPicture) {
        self.board.pictures.borrow_mut().push(picture);
    }

    /// Builds and draws what the settings ask for.
    pub async fn run(&mut self, settings: &Settings, size_px: [u32; 2], share: Share) -> Result<(), ExperimentError> {
        self.engine.request(settings, size_px)?;
        let left_out = self.engine.left_out();
        self.warn(&left_out);
        while let EngineState::Working { fraction } = self.engine.advance(self.board.budget.get())? {
            self.board.reach(share, fraction);
            pause().await;
        }
        Ok(())
    }

    /// A picture beside a row.
    pub async fn draw(&mut self, settings: &Settings, size_px: [u32; 2]) -> Result<(), ExperimentError> {
        let share = Share::none_after(self.board.fraction.get());
        self.say(share, "drawing");
        self.run(settings, size_px, share).await
    }

    /// Runs what no frame holds; times in order of recording.
    pub async fn run_job(&self, mut job: Job) -> Result<Vec<KernelTiming>, ExperimentError> {
        while job.advance(self.engine.gpu(), self.board.budget.get())? != JobState::Done {
            pause().await;
        }
        Ok(job.take_timings())
    }

    /// Work of the CPU, on a thread of its own. It is cancelled when nobody waits for it any more.
    pub async fn work<T: Send + 'static>(
        &self,
        (share, what): (Share, &str),
        work: impl FnOnce(&Progress) -> T + Send + 'static,
    ) -> Result<T, ExperimentError> {
        self.say(share, what);
        let waiting = Waiting { progress: Arc::new(Progress::default()), board: Rc::clone(&self.board) };
        let (sender, result) = channel();
        let (progress, waiter) = (Arc::clone(&waiting.progress), Wake(thread::current()));
        let thread = thread::Builder::new().spawn(move || {
            let waiter = waiter;
            // Nobody waits any more: the work was cancelled.
            let _ = sender.send(work(&progress));
            drop((sender, waiter));
        });
        thread.map_err(|cause| ExperimentError::NoThread { what: what.to_owned(), cause })?;
        self.board.waits_for_thread.set(true);
        loop {
            match result.try_recv() {
                Ok(done) => return Ok(done),
                Err(TryRecvError::Disconnected) => return Err(ExperimentError::Died(what.to_owned())),
                Err(TryRecvError::Empty) => pause().await,
            }
            self.board.reach(share, waiting.progress.fraction());
        }
    }
}

/// Lets go of a thread: it has ended, or shall end.
struct Waiting {
    progress: Arc<Progress>,
    board: Rc<Board>,
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.progress.cancel();
        self.board.waits_for_thread.set(false);
    }
}

/// Wakes who waits, also when the work panics.
struct Wake(thread::Thread);

impl Drop for Wake {
    fn drop(&mut self) {
        self.0.unpark();
    }
}

/// Back to the one who advances the experiment, once.
pub async fn pause() {
    let mut has_paused = false;
    std::future::poll_fn(|_| match std::mem::replace(&mut has_paused, true) {
        true => Poll::Ready(()),
        false => Poll::Pending,
    })
    .await;
}
