//! A pass on its way into a recording: a kernel, what it binds by name, and what it has to do.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::bindings::{Bound, Resource};
use super::counted::{Counted, CountedBy};
use super::kernel::Kernel;
use super::raster::RasterKernel;
use super::recorder::{Command, ComputePass, Draw, Recorder, Uniform};
use super::{GpuBuffer, GpuError};

/// Names what a kernel reads and writes.
#[must_use = "dispatch() or draw() records it"]
#[derive(Debug)]
pub struct PassBuilder<'a, K> {
    recorder: &'a mut Recorder,
    kernel: Arc<K>,
    named: Vec<(String, Resource)>,
    bytes_moved: u64,
    counted: Option<CountedBy>,
}

impl Recorder {
    /// Starts a pass; [`PassBuilder::dispatch`] ends it.
    pub fn pass(&mut self, kernel: &Arc<Kernel>) -> PassBuilder<'_, Kernel> {
        PassBuilder::new(self, kernel)
    }

    /// Starts a draw into the attachments recorded last; [`PassBuilder::draw`] ends it.
    pub fn triangles(&mut self, kernel: &Arc<RasterKernel>) -> PassBuilder<'_, RasterKernel> {
        PassBuilder::new(self, kernel)
    }
}

impl<'a, K> PassBuilder<'a, K> {
    pub(super) fn new(recorder: &'a mut Recorder, kernel: &Arc<K>) -> Self {
        Self { recorder, kernel: Arc::clone(kernel), named: Vec::new(), bytes_moved: 0, counted: None }
    }

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
    /// What the pass has had to do is told by what begins `buffer` when the recording has run: where threads end
    /// at a number that only the GPU knows, those recorded are a bound.
    pub fn counted<T: Pod>(mut self, buffer: &GpuBuffer, what: impl Fn(&T) -> Counted + Send + Sync + 'static) -> Self {
        self.counted = Some(CountedBy::new(buffer, what));
        self
    }

    /// Ends the pass: `threads` threads, which may be none.
    pub fn dispatch(self, threads: u64) {
        let Self { recorder, kernel, named, bytes_moved, counted } = self;
        let ready = kernel.pipeline.as_ref().map_err(Clone::clone);
        let bound = ready.and_then(|_| Bound::new(&kernel.name, &kernel.bindings, named));
        let pass = bound.and_then(|bound| {
            counted.as_ref().map_or(Ok(()), CountedBy::check)?;
            let refused = |_| GpuError::Threads {
                kernel: kernel.name.clone(),
                threads,
                cause: "thread numbers have 32 bits".to_owned(),
            };
            let threads = u32::try_from(threads).map_err(refused)?;
            Ok(Command::Pass(ComputePass { kernel, bound, threads, bytes_moved, counted }))
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
