//! What a job needs beside its recording: pieces of commands, buffers and queries.

use std::sync::Mutex;

use wgpu_profiler::{GpuProfiler, GpuProfilerQuery, GpuProfilerSettings};

use super::lock::lock;
use super::recorder::UNIFORM_ALIGNMENT;
use super::{GpuBuffer, GpuError, OpenDevice};

/// Thread ranges of a slice have this many places.
pub(super) const MAX_PIECES: usize = 256;
pub(super) const LABEL: &str = "job scratch";

/// Units `first..end` of a command: threads of a pass, bytes of a clear or copy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub command: usize,
    pub first: u64,
    pub end: u64,
    pub estimated_ns: f64,
}

/// Buffers and queries that one job at a time needs; kept for the next.
pub(super) struct Scratch {
    pub uniforms: GpuBuffer,
    /// Thread ranges of the pieces.
    pub ranges: GpuBuffer,
    /// `None` where the device has no timestamps.
    pub profiler: Option<GpuProfiler>,
}

impl Scratch {
    /// One of those that are free, or a new one; holds these uniforms then.
    pub fn take(gpu: &OpenDevice, free: &Mutex<Vec<Self>>, uniforms: &[u8]) -> Result<Self, GpuError> {
        let bytes = uniforms.len() as u64;
        let free = {
            let mut free = lock(free);
            let fitting = free.iter().position(|scratch| scratch.uniforms.bytes() >= bytes);
            fitting.map(|index| free.swap_remove(index))
        };
        let scratch = match free {
            Some(scratch) => scratch,
            None => Self::create(gpu, bytes)?,
        };
        gpu.write(&scratch.uniforms, 0, uniforms)?;
        Ok(scratch)
    }

    fn create(gpu: &OpenDevice, uniform_bytes: u64) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::UNIFORM;
        let range_bytes = (MAX_PIECES * UNIFORM_ALIGNMENT) as u64;
        let timestamps = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let profiler = || GpuProfiler::new(&gpu.device, GpuProfilerSettings::default());
        Ok(Self {
            uniforms: gpu.uncounted_buffer(LABEL, uniform_bytes.next_power_of_two().max(4096), usage)?,
            ranges: gpu.uncounted_buffer(LABEL, range_bytes, usage)?,
            profiler: timestamps.then(profiler).transpose().map_err(|e| gpu.refused("timestamps", &e.to_string()))?,
        })
    }
}

pub(super) fn end_query(encoder: &mut wgpu::CommandEncoder, query: Option<GpuProfilerQuery>, scratch: &Scratch) {
    if let (Some(query), Some(profiler)) = (query, &scratch.profiler) {
        profiler.end_query(encoder, query);
    }
}
