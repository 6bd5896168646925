//! Turns the pieces of a slice into one command buffer and submits it.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use bytemuck::{Pod, Zeroable};
use wgpu_profiler::{GpuProfiler, GpuProfilerQuery};

use super::bindings::buffer_binding;
use super::mirror::{Mirror, mirror};
use super::read_back::ReadBack;
use super::recorder::{Command, ComputePass, UNIFORM_ALIGNMENT};
use super::scratch::{LABEL, Piece, Scratch, end_query};
use super::{Gpu, GpuBuffer, GpuError, encode_raster, raster};

/// `Threads` of `shared/threads.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Threads {
    pub first: u32,
    pub end: u32,
}

pub const MIRRORS: &[Mirror] = &[mirror!(Threads, "shared/threads.wgsl", "Threads", first, end)];

/// Submits the pieces, and behind them the reads. The returned number becomes the nanoseconds the pieces took.
pub(super) fn submit(
    gpu: &Gpu,
    commands: &[Command],
    pieces: &[Piece],
    reads: &[(GpuBuffer, Range<u64>)],
    scratch: &mut Scratch,
) -> Result<(Arc<AtomicU64>, Option<ReadBack>), GpuError> {
    let took_ns = Arc::new(AtomicU64::new(0));
    write_ranges(gpu, pieces, scratch)?;
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(LABEL) });
    for (index, piece) in pieces.iter().enumerate() {
        match &commands[piece.command] {
            Command::Pass(pass) => {
                gpu.checked(&format!("kernel \"{}\"", pass.kernel.name), || {
                    encode_pass(gpu, &mut encoder, pass, piece, index, scratch)
                })??;
            }
            Command::Raster { target, draws } => {
                gpu.checked(raster::LABEL, || {
                    encode_raster::encode(gpu, &mut encoder, (target, draws), piece, scratch)
                })??;
            }
            command => encode_transfer(&mut encoder, command, piece, scratch),
        }
    }
    let read_back = if reads.is_empty() { None } else { Some(ReadBack::encode(gpu, &mut encoder, reads)?) };
    let finished = gpu.checked("recorded work", || {
        if let Some(profiler) = &mut scratch.profiler {
            profiler.resolve_queries(&mut encoder);
        }
        let (writer, start) = (Arc::clone(&took_ns), Instant::now());
        gpu.queue.submit([encoder.finish()]);
        gpu.queue.on_submitted_work_done(move || {
            writer.store((start.elapsed().as_nanos() as u64).max(1), Ordering::Release);
        });
        read_back.iter().for_each(ReadBack::map);
        scratch.profiler.as_mut().map_or(Ok(()), GpuProfiler::end_frame)
    })?;
    finished.map_err(|error| gpu.refused("timestamps", &error.to_string()))?;
    Ok((took_ns, read_back))
}

fn write_ranges(gpu: &Gpu, pieces: &[Piece], scratch: &Scratch) -> Result<(), GpuError> {
    let mut ranges = vec![0; pieces.len() * UNIFORM_ALIGNMENT];
    for (place, piece) in ranges.chunks_exact_mut(UNIFORM_ALIGNMENT).zip(pieces) {
        // Threads of a pass fit 32 bits; what a clear or copy leaves here nobody reads.
        let threads = Threads { first: piece.first as u32, end: piece.end as u32 };
        place[..size_of::<Threads>()].copy_from_slice(bytemuck::bytes_of(&threads));
    }
    gpu.write(&scratch.ranges, 0, &ranges)
}

fn encode_pass(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    pass: &ComputePass,
    piece: &Piece,
    index: usize,
    scratch: &Scratch,
) -> Result<(), GpuError> {
    let pipeline = pass.kernel.pipeline.as_ref().map_err(Clone::clone)?;
    let groups = folded_groups(gpu, pass, piece)?;
    let own = pass.bound.group(gpu, &pipeline.get_bind_group_layout(0), &scratch.uniforms)?;
    let ranged = pass.kernel.ranged.then(|| range_group(gpu, &pipeline.get_bind_group_layout(1), index, scratch));
    let query = scratch.profiler.as_ref().map(|profiler| profiler.begin_pass_query(&*pass.kernel.name, encoder));
    let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(&pass.kernel.name),
        timestamp_writes: query.as_ref().and_then(GpuProfilerQuery::compute_pass_timestamp_writes),
    });
    compute.set_pipeline(pipeline);
    compute.set_bind_group(0, &own, &[]);
    if let Some(ranged) = &ranged {
        compute.set_bind_group(1, ranged, &[]);
    }
    compute.dispatch_workgroups(groups[0], groups[1], 1);
    drop(compute);
    end_query(encoder, query, scratch);
    Ok(())
}

fn range_group(gpu: &Gpu, layout: &wgpu::BindGroupLayout, index: usize, scratch: &Scratch) -> wgpu::BindGroup {
    let start = (index * UNIFORM_ALIGNMENT) as u64;
    let resource = buffer_binding(&scratch.ranges, &(start..start + size_of::<Threads>() as u64));
    let entries = &[wgpu::BindGroupEntry { binding: 0, resource }];
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("threads"), layout, entries })
}

fn encode_transfer(encoder: &mut wgpu::CommandEncoder, command: &Command, piece: &Piece, scratch: &Scratch) {
    let query = scratch.profiler.as_ref().map(|profiler| profiler.begin_query("transfer", encoder));
    let bytes = piece.end - piece.first;
    match command {
        Command::Clear { buffer, .. } => encoder.clear_buffer(buffer.raw(), piece.first, Some(bytes)),
        Command::Copy { from, from_offset, to, to_offset, .. } => {
            let (from_offset, to_offset) = (from_offset + piece.first, to_offset + piece.first);
            encoder.copy_buffer_to_buffer(from.raw(), from_offset, to.raw(), to_offset, bytes);
        }
        Command::Pass(_) | Command::Raster { .. } => {}
    }
    end_query(encoder, query, scratch);
}

/// Workgroups of a range, in two dimensions once one has too few.
fn folded_groups(gpu: &Gpu, pass: &ComputePass, piece: &Piece) -> Result<[u32; 2], GpuError> {
    let size = u64::from(pass.kernel.workgroup_size[0]);
    let limit = u64::from(gpu.limits.max_compute_workgroups_per_dimension);
    let groups = (piece.end - piece.first).div_ceil(size);
    let rows = groups.div_ceil(limit).max(1);
    let row = groups.div_ceil(rows);
    let refused = |cause: &str| GpuError::Threads {
        kernel: pass.kernel.name.clone(),
        threads: u64::from(pass.threads),
        cause: cause.to_owned(),
    };
    if rows > 1 && !pass.kernel.ranged {
        return Err(refused(&format!("more than {limit} workgroups need thread_index() of shared/threads.wgsl")));
    }
    // The last row may be longer than the range; its numbers must not start at zero again.
    if piece.first + rows * row * size > 1 << 32 {
        return Err(refused("thread numbers have 32 bits"));
    }
    Ok([row as u32, rows as u32])
}
