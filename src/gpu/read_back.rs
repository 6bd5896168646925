//! Bytes on their way from the GPU: copied into a buffer that the CPU can map, at the end of a submission.

use std::ops::Range;
use std::sync::{Arc, Mutex};

use super::lock::lock;
use super::{GpuBuffer, GpuError, OpenDevice};

const LABEL: &str = "read-back";
/// The least that a mapping holds.
const MIN_BYTES: u64 = 16;

/// Copies that are encoded, and their answer.
#[derive(Debug)]
pub(super) struct ReadBack {
    staging: wgpu::Buffer,
    /// Where in `staging` each read lies.
    places: Vec<Range<u64>>,
    answer: Arc<Mutex<Option<Result<(), String>>>>,
}

impl ReadBack {
    /// Encodes the copies; [`Self::map`] must follow once they are submitted. Ranges are whole words inside
    /// their buffers.
    pub fn encode(
        gpu: &OpenDevice,
        encoder: &mut wgpu::CommandEncoder,
        reads: &[(GpuBuffer, Range<u64>)],
    ) -> Result<Self, GpuError> {
        let mut places = Vec::with_capacity(reads.len());
        let mut end = 0;
        for (_, range) in reads {
            let start = end;
            end += range.end - range.start;
            places.push(start..end);
        }
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let size = end.max(MIN_BYTES);
        let descriptor = wgpu::BufferDescriptor { label: Some(LABEL), size, usage, mapped_at_creation: false };
        let staging = gpu.allocated(LABEL, size, || gpu.device.create_buffer(&descriptor))?;
        for ((buffer, range), place) in reads.iter().zip(&places) {
            encoder.copy_buffer_to_buffer(buffer.raw(), range.start, &staging, place.start, place.end - place.start);
        }
        Ok(Self { staging, places, answer: Arc::default() })
    }

    /// Asks for the bytes of what is submitted by now.
    pub fn map(&self) {
        let writer = Arc::clone(&self.answer);
        self.staging.map_async(wgpu::MapMode::Read, .., move |result| {
            *lock(&writer) = Some(result.map_err(|error| error.to_string()));
        });
    }

    /// The bytes of each read once they are here, else `None`; who polls the device lets them come.
    pub fn take(&self, gpu: &OpenDevice) -> Result<Option<Vec<Vec<u8>>>, GpuError> {
        let Some(answer) = lock(&self.answer).clone() else { return Ok(None) };
        answer.map_err(|cause| gpu.refused(LABEL, &cause))?;
        let view = self.staging.get_mapped_range(..).map_err(|error| gpu.refused(LABEL, &error.to_string()))?;
        let bytes = |place: &Range<u64>| view[place.start as usize..place.end as usize].to_vec();
        Ok(Some(self.places.iter().map(bytes).collect()))
    }
}
