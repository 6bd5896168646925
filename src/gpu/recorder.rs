//! Recording: a list of passes, clears and copies, as data.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::kernel::{BindingKind, Kernel};
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

#[derive(Debug)]
pub(super) enum Command {
    Pass(Pass),
    Clear { buffer: GpuBuffer },
    Copy { from: GpuBuffer, from_offset: u64, to: GpuBuffer, to_offset: u64, bytes: u64 },
}

#[derive(Debug)]
pub(super) struct Pass {
    pub kernel: Arc<Kernel>,
    /// Binding number in group 0 and what is bound.
    pub bound: Vec<(u32, Resource)>,
    pub threads: u32,
    pub bytes_moved: u64,
}

#[derive(Debug)]
pub(super) enum Resource {
    Buffer(GpuBuffer, Range<u64>),
    Uniform(Range<u64>),
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Recorder {
    /// Starts a pass; [`PassBuilder::dispatch`] ends it.
    pub fn pass(&mut self, kernel: &Arc<Kernel>) -> PassBuilder<'_> {
        PassBuilder { recorder: self, kernel: Arc::clone(kernel), bound: Vec::new(), bytes_moved: 0 }
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
        if let Err(error) = checks {
            self.error.get_or_insert(error);
            return;
        }
        let (from, to) = (from.clone(), to.clone());
        self.commands.push(Command::Copy { from, from_offset, to, to_offset, bytes });
    }

    /// Puts another recording's commands behind these.
    pub fn append(&mut self, mut other: Self) {
        let shift = self.uniforms.len() as u64;
        for command in &mut other.commands {
            let Command::Pass(pass) = command else { continue };
            for (_, resource) in &mut pass.bound {
                if let Resource::Uniform(range) = resource {
                    *range = range.start + shift..range.end + shift;
                }
            }
        }
        self.commands.append(&mut other.commands);
        self.uniforms.append(&mut other.uniforms);
        self.error = self.error.take().or(other.error);
    }

    pub fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }
}

/// Names what a kernel reads and writes.
#[must_use = "a pass is recorded by dispatch()"]
#[derive(Debug)]
pub struct PassBuilder<'a> {
    recorder: &'a mut Recorder,
    kernel: Arc<Kernel>,
    bound: Vec<(String, Resource)>,
    bytes_moved: u64,
}

impl PassBuilder<'_> {
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
        let uniforms = &mut self.recorder.uniforms;
        let start = uniforms.len();
        uniforms.extend_from_slice(bytemuck::bytes_of(value));
        let end = uniforms.len();
        uniforms.resize(end.next_multiple_of(UNIFORM_ALIGNMENT), 0);
        self.with(name, Resource::Uniform(start as u64..end as u64))
    }

    /// Bytes the algorithm has to read and write, for the bandwidth column.
    pub fn bytes_moved(mut self, bytes: u64) -> Self {
        self.bytes_moved = bytes;
        self
    }

    /// Ends the pass: `threads` threads, which may be none.
    pub fn dispatch(self, threads: u64) {
        let pass = resolve(&self.kernel, self.bound).and_then(|bound| {
            let threads = u32::try_from(threads).map_err(|_| GpuError::Threads {
                kernel: self.kernel.name.clone(),
                threads,
                cause: "thread numbers have 32 bits".to_owned(),
            })?;
            Ok(Pass { kernel: self.kernel, bound, threads, bytes_moved: self.bytes_moved })
        });
        match pass {
            Ok(pass) => self.recorder.commands.push(Command::Pass(pass)),
            Err(error) => drop(self.recorder.error.get_or_insert(error)),
        }
    }

    fn with(mut self, name: &str, resource: Resource) -> Self {
        self.bound.push((name.to_owned(), resource));
        self
    }
}

/// Names to numbers: every binding that the kernel uses exactly once, and no other.
fn resolve(kernel: &Kernel, bound: Vec<(String, Resource)>) -> Result<Vec<(u32, Resource)>, GpuError> {
    let refused = |binding: &str, cause: &str| GpuError::Binding {
        kernel: kernel.name.clone(),
        binding: binding.to_owned(),
        cause: cause.to_owned(),
    };
    if let Err(error) = &kernel.pipeline {
        return Err(error.clone());
    }
    let mut resolved: Vec<(u32, Resource)> = Vec::with_capacity(bound.len());
    for (name, resource) in bound {
        let binding = kernel.binding(&name).ok_or_else(|| refused(&name, "the kernel does not use it"))?;
        if resolved.iter().any(|(number, _)| *number == binding.binding) {
            return Err(refused(&name, "bound twice"));
        }
        check_kind(binding.kind, &resource).map_err(|cause| refused(&name, &cause))?;
        resolved.push((binding.binding, resource));
    }
    match kernel.bindings.iter().find(|binding| resolved.iter().all(|(number, _)| *number != binding.binding)) {
        Some(missing) => Err(refused(&missing.name, "not bound")),
        None => match aliased(kernel, &resolved) {
            Some(aliased) => Err(refused(aliased, "the pass also writes this buffer through another binding")),
            None => Ok(resolved),
        },
    }
}

/// A binding that reads a buffer which the same pass writes: undefined, and refused by wgpu.
fn aliased<'a>(kernel: &'a Kernel, resolved: &[(u32, Resource)]) -> Option<&'a str> {
    let buffers = |writes: bool| {
        resolved.iter().filter_map(move |(number, resource)| {
            let binding = kernel.bindings.iter().find(|binding| binding.binding == *number)?;
            let writing = binding.kind == BindingKind::Storage { read_only: false };
            match resource {
                Resource::Buffer(buffer, _) if writing == writes => Some((binding, buffer)),
                _ => None,
            }
        })
    };
    let written = |read: &GpuBuffer| buffers(true).any(|(_, buffer)| buffer.raw() == read.raw());
    buffers(false).find(|(_, buffer)| written(buffer)).map(|(binding, _)| binding.name.as_str())
}

fn check_kind(kind: BindingKind, resource: &Resource) -> Result<(), String> {
    let fits = match resource {
        Resource::Buffer(..) => matches!(kind, BindingKind::Storage { .. } | BindingKind::Uniform),
        Resource::Uniform(_) => kind == BindingKind::Uniform,
        Resource::Texture(_) => kind == BindingKind::Texture,
        Resource::Sampler(_) => kind == BindingKind::Sampler,
    };
    let declared = match kind {
        BindingKind::Uniform => "uniform",
        BindingKind::Storage { .. } => "storage buffer",
        BindingKind::Texture => "texture",
        BindingKind::Sampler => "sampler",
    };
    if fits { Ok(()) } else { Err(format!("the kernel declares a {declared}, something else is bound")) }
}
