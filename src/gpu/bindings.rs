//! What is bound to a kernel: given by name when recording, by number when encoding.

use std::num::NonZeroU64;
use std::ops::Range;

use super::{GpuBuffer, GpuError, OpenDevice};

/// A variable of group 0 that an entry point uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelBinding {
    pub name: String,
    pub binding: u32,
    pub kind: BindingKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    Uniform,
    Storage { read_only: bool },
    Texture,
    Sampler,
}

#[derive(Debug)]
pub(super) enum Resource {
    Buffer(GpuBuffer, Range<u64>),
    /// Bytes of the recording's uniforms.
    Uniform(Range<u64>),
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

/// What a pass or draw binds: everything that its kernel uses, exactly once, and nothing else.
#[derive(Debug)]
pub(super) struct Bound {
    kernel: String,
    entries: Vec<(KernelBinding, Resource)>,
}

impl Bound {
    /// Names to numbers, checked against the `bindings` of `kernel`.
    pub fn new(kernel: &str, bindings: &[KernelBinding], named: Vec<(String, Resource)>) -> Result<Self, GpuError> {
        let mut bound = Self { kernel: kernel.to_owned(), entries: Vec::with_capacity(named.len()) };
        for (name, resource) in named {
            let binding = bindings.iter().find(|binding| binding.name == name);
            let binding = binding.ok_or_else(|| bound.refused(&name, "the kernel does not use it"))?;
            if bound.entries.iter().any(|(other, _)| other.binding == binding.binding) {
                return Err(bound.refused(&name, "bound twice"));
            }
            check_kind(binding.kind, &resource).map_err(|cause| bound.refused(&name, &cause))?;
            bound.entries.push((binding.clone(), resource));
        }
        let is_bound =
            |binding: &KernelBinding| bound.entries.iter().any(|(other, _)| other.binding == binding.binding);
        if let Some(missing) = bindings.iter().find(|binding| !is_bound(binding)) {
            return Err(bound.refused(&missing.name, "not bound"));
        }
        match bound.aliased() {
            Some(name) => Err(bound.refused(name, "the pass also writes this buffer through another binding")),
            None => Ok(bound),
        }
    }

    /// Moves the ranges of uniforms, whose bytes went behind others.
    pub fn shift_uniforms(&mut self, bytes: u64) {
        for (_, resource) in &mut self.entries {
            if let Resource::Uniform(range) = resource {
                *range = range.start + bytes..range.end + bytes;
            }
        }
    }

    /// The bind group for a pipeline's group 0.
    pub fn group(
        &self,
        gpu: &OpenDevice,
        layout: &wgpu::BindGroupLayout,
        uniforms: &GpuBuffer,
    ) -> Result<wgpu::BindGroup, GpuError> {
        let entries = self.entries.iter().map(|(binding, resource)| {
            self.check_size(gpu, binding, resource)?;
            Ok(wgpu::BindGroupEntry { binding: binding.binding, resource: binding_resource(resource, uniforms) })
        });
        let entries = &entries.collect::<Result<Vec<_>, GpuError>>()?;
        Ok(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(&self.kernel), layout, entries }))
    }

    /// A binding that reads a buffer which the same pass writes: undefined, and refused by wgpu.
    fn aliased(&self) -> Option<&str> {
        let writes = |binding: &KernelBinding| binding.kind == BindingKind::Storage { read_only: false };
        let buffers = || {
            self.entries.iter().filter_map(|(binding, resource)| match resource {
                Resource::Buffer(buffer, _) => Some((binding, buffer.raw())),
                _ => None,
            })
        };
        let written = |read: &wgpu::Buffer| buffers().any(|(binding, buffer)| writes(binding) && buffer == read);
        buffers().find(|(binding, buffer)| !writes(binding) && written(buffer)).map(|(binding, _)| &*binding.name)
    }

    fn check_size(&self, gpu: &OpenDevice, binding: &KernelBinding, resource: &Resource) -> Result<(), GpuError> {
        let Resource::Buffer(buffer, range) = resource else { return Ok(()) };
        let limit = match binding.kind {
            BindingKind::Uniform => gpu.limits.max_uniform_buffer_binding_size,
            _ => gpu.limits.max_storage_buffer_binding_size,
        };
        let bytes = range.end.saturating_sub(range.start);
        if range.end <= buffer.bytes() && bytes > 0 && bytes <= limit {
            return Ok(());
        }
        let (label, all, start) = (buffer.label(), buffer.bytes(), range.start);
        let cause =
            format!("{bytes} bytes of buffer \"{label}\" ({all} bytes) from {start} on; a binding holds 1 to {limit}");
        Err(self.refused(&binding.name, &cause))
    }

    fn refused(&self, binding: &str, cause: &str) -> GpuError {
        GpuError::Binding { kernel: self.kernel.clone(), binding: binding.to_owned(), cause: cause.to_owned() }
    }
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

fn binding_resource<'a>(resource: &'a Resource, uniforms: &'a GpuBuffer) -> wgpu::BindingResource<'a> {
    match resource {
        Resource::Buffer(buffer, range) => buffer_binding(buffer, range),
        Resource::Uniform(range) => buffer_binding(uniforms, range),
        Resource::Texture(view) => wgpu::BindingResource::TextureView(view),
        Resource::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
    }
}

pub(super) fn buffer_binding<'a>(buffer: &'a GpuBuffer, range: &Range<u64>) -> wgpu::BindingResource<'a> {
    let size = NonZeroU64::new(range.end.saturating_sub(range.start));
    wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: buffer.raw(), offset: range.start, size })
}
