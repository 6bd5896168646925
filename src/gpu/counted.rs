//! What passes had to do, where only the GPU knows it.

use std::fmt;
use std::ops::Range;

use bytemuck::Pod;

use super::cost::KernelTiming;
use super::recorder::Command;
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
    buffer: GpuBuffer,
    bytes: u64,
    what: Box<Tell>,
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

/// The buffers that a recording's passes are counted by, each once, as far as it is read.
pub(super) fn buffers(commands: &[Command]) -> Vec<(GpuBuffer, Range<u64>)> {
    let mut buffers: Vec<(GpuBuffer, Range<u64>)> = Vec::new();
    for (_, by) in counted(commands) {
        match buffers.iter_mut().find(|(buffer, _)| buffer.raw() == by.buffer.raw()) {
            Some((_, range)) => range.end = range.end.max(by.bytes),
            None => buffers.push((by.buffer.clone(), 0..by.bytes)),
        }
    }
    buffers
}

/// Puts down what the passes had to do; `bytes` are those of [`buffers`].
pub(super) fn put_down(commands: &[Command], bytes: &[Vec<u8>], timings: &mut [KernelTiming]) {
    let buffers = buffers(commands);
    for (command, by) in counted(commands) {
        let place = buffers.iter().position(|(buffer, _)| buffer.raw() == by.buffer.raw());
        let told = place.and_then(|place| bytes.get(place)?.get(..by.bytes as usize));
        if let (Some(told), Some(timing)) = (told, timings.get_mut(command)) {
            let counted = (by.what)(told);
            (timing.threads, timing.bytes_moved) = (counted.threads, counted.bytes);
        }
    }
}

fn counted(commands: &[Command]) -> impl Iterator<Item = (usize, &CountedBy)> {
    commands.iter().enumerate().filter_map(|(index, command)| match command {
        Command::Pass(pass) => Some((index, pass.counted.as_ref()?)),
        _ => None,
    })
}
