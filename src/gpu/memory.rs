//! Which buffers and textures live, and how many bytes they may have together.

use std::collections::BTreeMap;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};

use super::{Gpu, GpuError, lock};

/// A live buffer or texture, for the memory panel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferUse {
    pub label: String,
    pub bytes: u64,
}

/// What lives, by serial number.
#[derive(Debug, Default)]
pub(super) struct Live {
    uses: BTreeMap<u64, BufferUse>,
    /// Of all of them.
    bytes: u64,
    limit: Option<u64>,
}

pub(super) type Registry = Arc<Mutex<Live>>;

/// A place among what lives; dropping it leaves it.
#[derive(Debug)]
pub(super) struct Reserved {
    registry: Registry,
    serial: u64,
}

impl Drop for Reserved {
    fn drop(&mut self) {
        let mut live = lock(&self.registry);
        if let Some(gone) = live.uses.remove(&self.serial) {
            live.bytes -= gone.bytes;
        }
    }
}

impl Gpu {
    /// Live buffers and textures in the order they were made.
    pub fn memory(&self) -> Vec<BufferUse> {
        lock(&self.registry).uses.values().cloned().collect()
    }

    /// Bytes of all of them.
    pub fn bytes_in_use(&self) -> u64 {
        lock(&self.registry).bytes
    }

    /// From here on, what would bring them beyond so many bytes is refused; `None`: the device decides.
    pub fn limit_memory(&self, bytes: Option<u64>) {
        lock(&self.registry).limit = bytes;
    }

    /// Counts something in before it is made, so that two threads cannot pass the limit together.
    pub(super) fn reserve(&self, label: &str, bytes: u64) -> Result<Reserved, GpuError> {
        let mut live = lock(&self.registry);
        let after = live.bytes.saturating_add(bytes);
        if let Some(limit) = live.limit.filter(|limit| after > *limit) {
            let cause = format!("with the {} bytes in use it would be more than the limit of {limit}", live.bytes);
            return Err(GpuError::OutOfMemory { label: label.to_owned(), bytes, cause });
        }
        let serial = self.serial.fetch_add(1, Ordering::Relaxed);
        live.uses.insert(serial, BufferUse { label: label.to_owned(), bytes });
        live.bytes = after;
        Ok(Reserved { registry: Arc::clone(&self.registry), serial })
    }

    /// Runs the call of wgpu that makes something; without memory for it the error says so.
    pub(super) fn allocated<T>(&self, label: &str, bytes: u64, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        self.checked(label, make).map_err(|error| match error {
            GpuError::Refused { cause, .. } => GpuError::OutOfMemory { label: label.to_owned(), bytes, cause },
            error => error,
        })
    }
}
