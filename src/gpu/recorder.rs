//! Recording: a list of passes, clears, copies and draws, as data.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::bindings::{Bound, Resource};
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
    /// All uniforms of all passes, each at a multiple of [`UNIFORM_ALIGNMENT`].
    pub(super) uniforms: Vec<u8>,
    pub(super) error: Option<GpuError>,
}

/// A uniform that several passes of one recording share.
#[derive(Clone, Debug)]
pub struct Uniform(Range<u64>);

#[derive(Debug)]
pub(super) enum Command {
    Pass(Pass),
    Raster { target: RasterTarget, draws: Vec<Draw> },
    Clear { buffer: GpuBuffer },
    Copy { from: GpuBuffer, from_offset: u64, to: GpuBuffer, to_offset: u64, bytes: u64 },
}

#[derive(Debug)]
pub(super) struct Pass {
    pub kernel: Arc<Kernel>,
    pub bound: Bound,
    pub threads: u32,
    pub bytes_moved: u64,
}

#[derive(Debug)]
pub(super) struct Draw {
    pub kernel: Arc<RasterKernel>,
    pub bound: Bound,
    pub vertices: u32,
}

impl Recorder {
    /// Starts a pass; [`PassBuilder::dispatch`] ends it.
    pub fn pass(&mut self, kernel: &Arc<Kernel>) -> PassBuilder<'_, Kernel> {
        PassBuilder { recorder: self, kernel: Arc::clone(kernel), named: Vec::new(), bytes_moved: 0 }
    }

    /// Clears attachments; the draws that follow go into them.
    pub fn raster(&mut self, target: RasterTarget) {
        self.commands.push(Command::Raster { target, draws: Vec::new() });
    }

    /// Starts a draw into the attachments recorded last; [`PassBuilder::draw`] ends it.
    pub fn triangles(&mut self, kernel: &Arc<RasterKernel>) -> PassBuilder<'_, RasterKernel> {
        PassBuilder { recorder: self, kernel: Arc::clone(kernel), named: Vec::new(), bytes_moved: 0 }
    }

    /// Writes a uniform down once, for [`PassBuilder::shared`] in this recording.
    pub fn uniform<T: Pod>(&mut self, value: &T) -> Uniform {
        let start = self.uniforms.len();
        self.uniforms.extend_from_slice(bytemuck::bytes_of(value));
        let end = self.uniforms.len();
        self.uniforms.resize(end.next_multiple_of(UNIFORM_ALIGNMENT), 0);
        Uniform(start as u64..end as u64)
    }

    /// Sets all bytes to zero.
    pub fn clear(&mut self, buffer: &GpuBuffer) {
        self.commands.push(Command::Clear { buffer: buffer.clone() });
    }

    /// Copies whole words between two different buffers.
    pub fn copy(&mut self, from: &GpuBuffer, from_offset: u64, to: &GpuBuffer, to_offset: u64, bytes: u64) {
        let checks = from
            .checked("copy", from_offset..from_offset.saturating_add(bytes), 4)
            .and_then(|()| to.checked("copy", to_offset..to_offset.saturating_add(bytes), 4));
        let (from, to) = (from.clone(), to.clone());
        self.push(checks.map(|()| Command::Copy { from, from_offset, to, to_offset, bytes }));
    }

    /// Puts another recording's commands behind these.
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
        self.uniforms.append(&mut other.uniforms);
        self.error = self.error.take().or(other.error);
    }

    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }

    fn push(&mut self, command: Result<Command, GpuError>) {
        match command {
            Ok(command) => self.commands.push(command),
            Err(error) => drop(self.error.get_or_insert(error)),
        }
    }
}

/// Names what a kernel reads and writes.
#[must_use = "dispatch() or draw() records it"]
#[derive(Debug)]
pub struct PassBuilder<'a, K> {
    recorder: &'a mut Recorder,
    kernel: Arc<K>,
    named: Vec<(String, Resource)>,
    bytes_moved: u64,
}

impl<K> PassBuilder<'_, K> {
    pub fn bind(self, name: &str, buffer: &GpuBuffer) -> Self {
        self.bind_range(name, buffer, 0..buffer.bytes())
    }

    /// A part of a buffer; it starts at a multiple of 256 bytes.
    pub fn bind_range(self, name: &str, buffer: &GpuBuffer, range_bytes: Range<u64>) -> Self {
        self.with(name, Resource::Buffer(buffer.clone(), range_bytes))
    }

    pub fn texture(self, name: &str, view: &wgpu::TextureView) -> Self {
        self.with(name, Resource::Texture(view.clone()))
    }

    pub fn sampler(self, name: &str, sampler: &wgpu::Sampler) -> Self {
        self.with(name, Resource::Sampler(sampler.clone()))
    }

    pub fn uniform<T: Pod>(self, name: &str, value: &T) -> Self {
        let uniform = self.recorder.uniform(value);
        self.shared(name, &uniform)
    }

    pub fn shared(self, name: &str, uniform: &Uniform) -> Self {
        self.with(name, Resource::Uniform(uniform.0.clone()))
    }

    /// Bytes the algorithm has to read and write, for the bandwidth column.
    pub fn bytes_moved(mut self, bytes: u64) -> Self {
        self.bytes_moved = bytes;
        self
    }

    fn with(mut self, name: &str, resource: Resource) -> Self {
        self.named.push((name.to_owned(), resource));
        self
    }
}

impl PassBuilder<'_, Kernel> {
    /// Ends the pass: `threads` threads, which may be none.
    pub fn dispatch(self, threads: u64) {
        let Self { recorder, kernel, named, bytes_moved } = self;
        let ready = kernel.pipeline.as_ref().map_err(Clone::clone);
        let bound = ready.and_then(|_| Bound::new(&kernel.name, &kernel.bindings, named));
        let pass = bound.and_then(|bound| {
            let refused = |_| GpuError::Threads {
                kernel: kernel.name.clone(),
                threads,
                cause: "thread numbers have 32 bits".to_owned(),
            };
            let threads = u32::try_from(threads).map_err(refused)?;
            Ok(Command::Pass(Pass { kernel, bound, threads, bytes_moved }))
        });
        recorder.push(pass);
    }
}

impl PassBuilder<'_, RasterKernel> {
    /// Ends the draw: three vertices a triangle.
    pub fn draw(self, vertices: u32) {
        let Self { recorder, kernel, named, .. } = self;
        let ready = kernel.pipeline.as_ref().map_err(Clone::clone);
        let bound = ready.and_then(|_| Bound::new(&kernel.name, &kernel.bindings, named));
        match (bound, recorder.commands.last_mut()) {
            (Ok(bound), Some(Command::Raster { draws, .. })) => draws.push(Draw { kernel, bound, vertices }),
            (Err(error), _) => recorder.push(Err(error)),
            (Ok(_), _) => {
                let what = format!("a draw of \"{}\"", kernel.name);
                recorder
                    .push(Err(GpuError::Refused { what, cause: "no attachments were recorded before it".to_owned() }));
            }
        }
    }
}
