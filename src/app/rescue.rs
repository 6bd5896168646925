//! What outlives a lost GPU. The window itself paints on that GPU, so it cannot ask whether to go on:
//! it closes, and is opened again with what it kept.

use std::sync::{Arc, Mutex, PoisonError};

use super::loader::Ready;
use super::start::Start;

/// Scene and settings of a window that lost its GPU.
pub struct Kept {
    pub(super) start: Start,
    pub(super) scene: Option<Ready>,
    /// One sentence.
    pub(super) cause: String,
}

/// Where a window leaves what the next one goes on with.
#[derive(Clone, Default)]
pub struct Rescue(Arc<Mutex<Option<Kept>>>);

impl Rescue {
    pub fn take(&self) -> Option<Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub fn leave(&self, kept: Kept) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }
}
