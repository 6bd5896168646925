//! Counts of a recording: which buffers hold them, and what they say of its passes.

use std::ops::Range;

use super::GpuBuffer;
use super::cost::KernelTiming;
use super::counted::CountedBy;
use super::recorder::Command;

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
