//! Long CPU work on a thread of its own. Its end wakes the window; dropping it cancels it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::progress::Progress;

pub struct Background<T> {
    progress: Arc<Progress>,
    result: Receiver<T>,
    ended: Arc<AtomicBool>,
}

/// What became of the work.
#[derive(Debug, PartialEq, Eq)]
pub enum Outcome<T> {
    Running,
    Done(T),
    /// The thread panicked.
    Died,
}

impl<T: Send + 'static> Background<T> {
    pub fn start(ctx: &egui::Context, work: impl FnOnce(&Progress) -> T + Send + 'static) -> Self {
        let progress = Arc::new(Progress::default());
        let (sender, result) = channel();
        let (ctx, shared) = (ctx.clone(), Arc::clone(&progress));
        let ended = Arc::new(AtomicBool::new(false));
        let end = Arc::clone(&ended);
        std::thread::spawn(move || {
            let wake = Wake { ctx, end };
            // Nobody waits any more: the work was cancelled.
            let _ = sender.send(work(&shared));
            drop(sender);
            drop(wake);
        });
        Self { progress, result, ended }
    }

    pub fn poll(&self) -> Outcome<T> {
        match self.result.try_recv() {
            Ok(result) => Outcome::Done(result),
            Err(TryRecvError::Empty) => Outcome::Running,
            Err(TryRecvError::Disconnected) => Outcome::Died,
        }
    }

    /// Whether [`Self::poll`] has an answer.
    pub fn has_ended(&self) -> bool {
        self.ended.load(Ordering::Acquire)
    }

    /// Asks the work to end; what it ends with still arrives.
    pub fn cancel(&self) {
        self.progress.cancel();
    }

    /// Between 0 and 1.
    pub fn fraction(&self) -> f32 {
        self.progress.fraction()
    }
}

impl<T> Drop for Background<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

/// Wakes the window also when the work panics.
struct Wake {
    ctx: egui::Context,
    end: Arc<AtomicBool>,
}

impl Drop for Wake {
    fn drop(&mut self) {
        self.end.store(true, Ordering::Release);
        self.ctx.request_repaint();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T: Send + 'static>(work: &Background<T>) -> Outcome<T> {
        loop {
            match work.poll() {
                Outcome::Running => std::thread::yield_now(),
                outcome => return outcome,
            }
        }
    }

    #[test]
    fn results_arrive_and_panics_are_noticed() {
        let ctx = egui::Context::default();
        assert_eq!(wait(&Background::start(&ctx, |_| 7)), Outcome::Done(7));
        assert_eq!(wait(&Background::<u32>::start(&ctx, |_| std::panic::resume_unwind(Box::new(())))), Outcome::Died);
    }

    #[test]
    fn dropping_it_cancels_the_work() {
        let ctx = egui::Context::default();
        let (sender, ended) = channel();
        drop(Background::start(&ctx, move |progress| {
            while progress.advance(1).is_ok() {
                std::thread::yield_now();
            }
            sender.send(()).ok();
        }));
        assert_eq!(ended.recv(), Ok(()));
    }
}
