//! Buffers, brought back.

use std::ops::Range;

use bytemuck::Pod;

use super::read_back::ReadBack;
use super::{GpuBuffer, GpuError, OpenDevice};

/// A read goes through staging buffers of at most this size.
const READ_CHUNK_BYTES: u64 = 32 << 20;

impl OpenDevice {
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
}

/// Bytes on their way from the GPU.
#[derive(Debug)]
pub struct PendingRead(ReadBack);

impl PendingRead {
    /// The bytes once they are here, else `None`; never blocks.
    pub fn take(&self, gpu: &OpenDevice) -> Result<Option<Vec<u8>>, GpuError> {
        gpu.poll()?;
        Ok(self.0.take(gpu)?.and_then(|mut reads| reads.pop()))
    }
}
