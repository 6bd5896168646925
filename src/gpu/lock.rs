//! Mutexes around plain collections.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// A panic in another thread leaves these plain collections usable.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
