//! What passes had to do, where only the GPU knows it.

use std::fmt;

use bytemuck::Pod;

use super::{GpuBuffer, GpuError};

/// What a pass had to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counted {
    pub threads: u64,
    /// That a kernel must move for what is there, whatever its buffers could hold.
    pub bytes: u64,
}

type Tell = dyn Fn(&[u8]) -> Counted + Send + Sync;

/// Where it is told, and how that is read.
pub(super) struct CountedBy {
    pub buffer: GpuBuffer,
    pub bytes: u64,
    pub what: Box<Tell>,
}

impl fmt::Debug for CountedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CountedBy").field("buffer", &self.buffer).field("bytes", &self.bytes).finish_non_exhaustive()
    }
}

impl CountedBy {
    pub fn new<T: Pod>(buffer: &GpuBuffer, what: impl Fn(&T) -> Counted + Send + Sync + 'static) -> Self {
        let what = Box::new(move |bytes: &[u8]| what(&bytemuck::pod_read_unaligned(bytes)));
        Self { buffer: buffer.clone(), bytes: size_of::<T>() as u64, what }
    }

    pub fn check(&self) -> Result<(), GpuError> {
        self.buffer.checked("count", 0..self.bytes, 4)
    }
}
