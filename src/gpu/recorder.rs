//! Recording: a list of passes, clears, copies and draws, as data, and what is wanted back of buffers.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::bindings::Bound;
use super::counted::CountedBy;
use super::kernel::Kernel;
use super::raster::{RasterKernel, RasterTarget};
use super::{GpuBuffer, GpuError};

/// wgpu's coarsest alignment of a uniform's offset.
pub(super) const UNIFORM_ALIGNMENT: usize = 256;

/// A recorded list of commands; nothing runs until a [`super::Job`] runs it, and mistakes made
/// here are that job's error.
#[derive(Debug, Default)]
pub struct Recorder {
    pub(super) commands: Vec<Command>,
    /// Of each command.
    pub(super) groups: Vec<u32>,
    /// Of the commands to come.
    group: u32,
    /// What is wanted back, by number.
    pub(super) reads: Vec<(GpuBuffer, Range<u64>)>,
    /// All uniforms of all passes, each at a multiple of [`UNIFORM_ALIGNMENT`].
    pub(super) uniforms: Vec<u8>,
    pub(super) error: Option<GpuError>,
}

/// A uniform that several passes of one recording share.
#[derive(Clone, Debug)]
pub struct Uniform(pub(super) Range<u64>);

#[derive(Debug)]
pub(super) enum Command {
    Pass(ComputePass),
    Raster { target: RasterTarget, draws: Vec<Draw> },
    Clear { buffer: GpuBuffer, bytes: u64 },
    Copy { from: GpuBuffer, from_offset: u64, to: GpuBuffer, to_offset: u64, bytes: u64 },
}

#[derive(Debug)]
pub(super) struct ComputePass {
    pub kernel: Arc<Kernel>,
    pub bound: Bound,
    pub threads: u32,
    pub bytes_moved: u64,
    pub counted: Option<CountedBy>,
}

#[derive(Debug)]
pub(super) struct Draw {
    pub kernel: Arc<RasterKernel>,
    pub bound: Bound,
    pub vertices: u32,
}

impl Recorder {
    /// Commands recorded from here on belong to this group, a number by which the caller knows them again in
    /// their timings; those before the first call belong to 0.
    pub fn begin(&mut self, group: u32) {
        self.group = group;
    }

    /// Clears attachments; the draws that follow go into them.
    pub fn raster(&mut self, target: RasterTarget) {
        self.push(Ok(Command::Raster { target, draws: Vec::new() }));
    }

    /// Writes a uniform down once, for [`super::PassBuilder::shared`] in this recording.
    pub fn uniform<T: Pod>(&mut self, value: &T) -> Uniform {
        let start = self.uniforms.len();
        self.uniforms.extend_from_slice(bytemuck::bytes_of(value));
        let end = self.uniforms.len();
        self.uniforms.resize(end.next_multiple_of(UNIFORM_ALIGNMENT), 0);
        Uniform(start as u64..end as u64)
    }

    /// Sets all bytes to zero.
    pub fn clear(&mut self, buffer: &GpuBuffer) {
        self.clear_part(buffer, buffer.bytes());
    }

    /// Sets the first bytes to zero, whole words: what is used of a buffer that may be larger.
    pub fn clear_part(&mut self, buffer: &GpuBuffer, bytes: u64) {
        let checks = buffer.checked("clear", 0..bytes, 4);
        self.push(checks.map(|()| Command::Clear { buffer: buffer.clone(), bytes }));
    }

    /// Copies whole words between two different buffers.
    pub fn copy(&mut self, from: &GpuBuffer, from_offset: u64, to: &GpuBuffer, to_offset: u64, bytes: u64) {
        let checks = from
            .checked("copy", from_offset..from_offset.saturating_add(bytes), 4)
            .and_then(|()| to.checked("copy", to_offset..to_offset.saturating_add(bytes), 4));
        let (from, to) = (from.clone(), to.clone());
        self.push(checks.map(|()| Command::Copy { from, from_offset, to, to_offset, bytes }));
    }

    /// Asks for bytes (whole words) as they are when every command has run; the number is that of the read in
    /// [`super::Job::take_reads`].
    pub fn read(&mut self, buffer: &GpuBuffer, range_bytes: Range<u64>) -> usize {
        if let Err(error) = buffer.checked("read", range_bytes.clone(), 4) {
            self.error.get_or_insert(error);
        }
        self.reads.push((buffer.clone(), range_bytes));
        self.reads.len() - 1
    }

    /// Puts another recording's commands behind these; they keep their groups, and its reads get the numbers
    /// behind those that are here.
    pub fn append(&mut self, mut other: Self) {
        let shift = self.uniforms.len() as u64;
        for command in &mut other.commands {
            match command {
                Command::Pass(pass) => pass.bound.shift_uniforms(shift),
                Command::Raster { draws, .. } => draws.iter_mut().for_each(|draw| draw.bound.shift_uniforms(shift)),
                Command::Clear { .. } | Command::Copy { .. } => {}
            }
        }
        self.commands.append(&mut other.commands);
        self.groups.append(&mut other.groups);
        self.reads.append(&mut other.reads);
        self.uniforms.append(&mut other.uniforms);
        self.error = self.error.take().or(other.error);
    }

    pub fn is_empty(&self) -> bool {
        self.commands.is_empty() && self.reads.is_empty()
    }

    pub(super) fn push(&mut self, command: Result<Command, GpuError>) {
        match command {
            Ok(command) => {
                self.commands.push(command);
                self.groups.push(self.group);
            }
            Err(error) => drop(self.error.get_or_insert(error)),
        }
    }
}
