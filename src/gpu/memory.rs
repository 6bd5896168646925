//! Which buffers and textures live, and how many bytes they may have together.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use super::GpuError;
use super::lock::lock;

/// A live buffer or texture, for the memory panel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferUse {
    pub label: String,
    pub bytes: u64,
}

/// What lives, by serial number.
#[derive(Debug, Default)]
struct Live {
    uses: BTreeMap<u64, BufferUse>,
    /// Of all of them.
    bytes: u64,
    limit: Option<u64>,
}

/// A place among what lives; dropping it leaves it.
#[derive(Debug)]
pub(super) struct Reserved {
    live: Arc<Mutex<Live>>,
    serial: u64,
}

impl Drop for Reserved {
    fn drop(&mut self) {
        let mut live = lock(&self.live);
        if let Some(gone) = live.uses.remove(&self.serial) {
            live.bytes -= gone.bytes;
        }
    }
}

/// All of it.
#[derive(Debug, Default)]
pub(super) struct Memory {
    live: Arc<Mutex<Live>>,
    serial: AtomicU64,
}

impl Memory {
    /// In the order they were made.
    pub fn uses(&self) -> Vec<BufferUse> {
        lock(&self.live).uses.values().cloned().collect()
    }

    pub fn bytes(&self) -> u64 {
        lock(&self.live).bytes
    }

    /// From here on, what would bring all of it beyond so many bytes is refused.
    pub fn limit(&self, bytes: Option<u64>) {
        lock(&self.live).limit = bytes;
    }

    /// Counts something in before it is made, so that two threads cannot pass the limit together.
    pub fn reserve(&self, label: &str, bytes: u64) -> Result<Reserved, GpuError> {
        let mut live = lock(&self.live);
        let after = live.bytes.saturating_add(bytes);
        if let Some(limit) = live.limit.filter(|limit| after > *limit) {
            let cause = format!("with the {} bytes in use it would be more than the limit of {limit}", live.bytes);
            return Err(GpuError::OutOfMemory { label: label.to_owned(), bytes, cause });
        }
        let serial = self.serial.fetch_add(1, Ordering::Relaxed);
        live.uses.insert(serial, BufferUse { label: label.to_owned(), bytes });
        live.bytes = after;
        Ok(Reserved { live: Arc::clone(&self.live), serial })
    }
}
