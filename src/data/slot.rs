//! A place for a buffer that grows with what is put there.

use crate::gpu::{Gpu, GpuBuffer, GpuError};

/// A buffer made on first need and made again, larger, when it no longer suffices.
#[derive(Clone, Debug, Default)]
pub struct Slot(Option<GpuBuffer>);

impl Slot {
    /// At least `bytes` large. Contents are undefined after growth.
    pub fn ensure(&mut self, gpu: &Gpu, label: &str, bytes: u64) -> Result<GpuBuffer, GpuError> {
        self.ensure_as(gpu, label, bytes, wgpu::BufferUsages::empty())
    }

    /// The same with usages beside those that every buffer has.
    pub fn ensure_as(
        &mut self,
        gpu: &Gpu,
        label: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<GpuBuffer, GpuError> {
        if let Some(buffer) = &self.0
            && buffer.bytes() >= bytes
            && buffer.raw().usage().contains(usage)
        {
            return Ok(buffer.clone());
        }
        let limit = gpu.limits.max_storage_buffer_binding_size;
        if bytes > limit {
            let (label, adapter) = (label.to_owned(), gpu.info.name.clone());
            return Err(GpuError::BufferTooLarge { label, bytes, limit, adapter });
        }
        // The old one goes first: both at once might not fit.
        let grown = self.0.take().is_some_and(|buffer| buffer.bytes() < bytes);
        let bytes = bytes.max(4).next_multiple_of(4);
        // Growing by an eighth more than asked keeps a slowly growing scene from reallocating every frame.
        let roomy = if grown { bytes + (bytes / 8).next_multiple_of(4) } else { bytes };
        let buffer = gpu.buffer(label, if roomy <= limit { roomy } else { bytes }, usage)?;
        Ok(self.0.insert(buffer).clone())
    }

    /// The buffer, where an earlier stage must have made it.
    pub fn made(&self, label: &str) -> Result<GpuBuffer, GpuError> {
        self.0.clone().ok_or_else(|| GpuError::Missing { label: label.to_owned() })
    }

    pub fn get(&self) -> Option<&GpuBuffer> {
        self.0.as_ref()
    }

    /// Of the buffer that is there.
    pub fn bytes(&self) -> u64 {
        self.0.as_ref().map_or(0, GpuBuffer::bytes)
    }

    pub fn free(&mut self) {
        self.0 = None;
    }
}
