//! GPU buffers that say how large they are, and how to get bytes in and out.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::memory::Reserved;
use super::{GpuError, OpenDevice};

/// No binding is smaller, so that an empty array still holds one element of 16 bytes.
const MIN_BYTES: u64 = 16;

/// A shared handle: clones are the same memory.
#[derive(Clone, Debug)]
pub struct GpuBuffer(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    raw: wgpu::Buffer,
    label: String,
    _reserved: Reserved,
}

impl GpuBuffer {
    pub fn label(&self) -> &str {
        &self.0.label
    }

    /// What was asked for, rounded up to whole words, at least 16.
    pub fn bytes(&self) -> u64 {
        self.0.raw.size()
    }

    pub fn raw(&self) -> &wgpu::Buffer {
        &self.0.raw
    }

    /// The range as is, or a sentence when it leaves the buffer or splits a unit.
    pub(super) fn checked(&self, what: &'static str, range: Range<u64>, alignment: u64) -> Result<(), GpuError> {
        let inside = range.start <= range.end && range.end <= self.bytes();
        if inside && range.start.is_multiple_of(alignment) && range.end.is_multiple_of(alignment) {
            return Ok(());
        }
        let (label, bytes) = (self.label().to_owned(), self.bytes());
        Err(GpuError::Range { what, label, bytes, alignment, start: range.start, end: range.end })
    }
}

impl OpenDevice {
    /// A zeroed buffer; `STORAGE | COPY_SRC | COPY_DST` come by themselves.
    pub fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<GpuBuffer, GpuError> {
        let buffer = self.uncounted_buffer(label, bytes, usage)?;
        self.counted(|counters| counters.buffers += 1);
        Ok(buffer)
    }

    /// A storage buffer holding `data`.
    pub fn upload<T: Pod>(&self, label: &str, data: &[T]) -> Result<GpuBuffer, GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let buffer = self.buffer(label, bytes.len() as u64, wgpu::BufferUsages::empty())?;
        self.write(&buffer, 0, bytes)?;
        Ok(buffer)
    }

    /// Overwrites bytes before anything submitted later runs. A tail that is no whole word is
    /// filled up with zeros.
    pub fn write(&self, buffer: &GpuBuffer, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        let (whole, tail) = bytes.split_at(bytes.len() & !3);
        let end = offset + whole.len() as u64;
        let padded_end = end + if tail.is_empty() { 0 } else { 4 };
        buffer.checked("write", offset..padded_end, 4)?;
        self.queue.write_buffer(buffer.raw(), offset, whole);
        if !tail.is_empty() {
            let mut word = [0; 4];
            word[..tail.len()].copy_from_slice(tail);
            self.queue.write_buffer(buffer.raw(), end, &word);
        }
        Ok(())
    }

    pub(super) fn uncounted_buffer(
        &self,
        label: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<GpuBuffer, GpuError> {
        use wgpu::BufferUsages as Usage;
        let limit = self.limits.max_buffer_size;
        if bytes > limit {
            let (label, adapter) = (label.to_owned(), self.info.name.clone());
            return Err(GpuError::BufferTooLarge { label, bytes, limit, adapter });
        }
        let size = bytes.next_multiple_of(4).max(MIN_BYTES);
        let usage = usage | Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST;
        let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
        let reserved = self.reserve(label, size)?;
        let raw = self.allocated(label, bytes, || self.device.create_buffer(&descriptor))?;
        Ok(GpuBuffer(Arc::new(Inner { raw, label: label.to_owned(), _reserved: reserved })))
    }
}
