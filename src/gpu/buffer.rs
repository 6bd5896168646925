//! GPU buffers that say how large they are, and how to get bytes in and out.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::Pod;

use super::memory::Reserved;
use super::read_back::ReadBack;
use super::{Gpu, GpuError};

/// No binding is smaller, so that an empty array still holds one element of 16 bytes.
const MIN_BYTES: u64 = 16;
/// A read goes through staging buffers of at most this size.
const READ_CHUNK_BYTES: u64 = 32 << 20;

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

impl Gpu {
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

    /// Blocks until all submitted work is done and the bytes are here.
    pub fn read<T: Pod>(&self, buffer: &GpuBuffer, range_bytes: Range<u64>) -> Result<Vec<T>, GpuError> {
        buffer.checked("read", range_bytes.clone(), 4)?;
        buffer.checked("read", range_bytes.clone(), size_of::<T>() as u64)?;
        let mut data = vec![T::zeroed(); (range_bytes.end - range_bytes.start) as usize / size_of::<T>()];
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut data);
        for (chunk, start) in
            bytes.chunks_mut(READ_CHUNK_BYTES as usize).zip((range_bytes.start..).step_by(READ_CHUNK_BYTES as usize))
        {
            let read = self.start_read(buffer, start..start + chunk.len() as u64)?;
            chunk.copy_from_slice(&self.wait_for(&read)?);
        }
        Ok(data)
    }

    /// Blocks until the bytes are here. Where two threads wait, either may be the one to deliver what
    /// both wait for, so that work can be done before its answer has come.
    fn wait_for(&self, read: &PendingRead) -> Result<Vec<u8>, GpuError> {
        loop {
            self.wait()?;
            if let Some(bytes) = read.take(self)? {
                return Ok(bytes);
            }
            std::thread::yield_now();
        }
    }

    /// Copies a range (whole words) as of now; the answer comes later, without blocking.
    pub fn start_read(&self, buffer: &GpuBuffer, range_bytes: Range<u64>) -> Result<PendingRead, GpuError> {
        buffer.checked("read", range_bytes.clone(), 4)?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let read_back = ReadBack::encode(self, &mut encoder, &[(buffer.clone(), range_bytes)])?;
        self.checked(&format!("read {}", buffer.label()), || self.queue.submit([encoder.finish()]))?;
        read_back.map();
        Ok(PendingRead(read_back))
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

/// Bytes on their way from the GPU.
#[derive(Debug)]
pub struct PendingRead(ReadBack);

impl PendingRead {
    /// The bytes once they are here, else `None`; never blocks.
    pub fn take(&self, gpu: &Gpu) -> Result<Option<Vec<u8>>, GpuError> {
        gpu.poll()?;
        Ok(self.0.take(gpu)?.and_then(|mut reads| reads.pop()))
    }
}
