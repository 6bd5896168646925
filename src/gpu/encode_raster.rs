//! Draws of a slice, put into a command buffer.

use wgpu_profiler::GpuProfilerQuery;

use super::raster::{LABEL, RasterTarget};
use super::recorder::Draw;
use super::scratch::{Piece, Scratch, end_query};
use super::{Gpu, GpuError};

/// Vertices `piece.first..piece.end` of all draws, counted through.
pub(super) fn encode(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    (target, draws): (&RasterTarget, &[Draw]),
    piece: &Piece,
    scratch: &Scratch,
) -> Result<(), GpuError> {
    let mut ready = Vec::new();
    let mut before = 0;
    for draw in draws {
        let after = before + u64::from(draw.vertices);
        let (first, end) = (piece.first.clamp(before, after), piece.end.clamp(before, after));
        if first < end {
            let pipeline = draw.kernel.pipeline.as_ref().map_err(Clone::clone)?;
            let group = draw.bound.group(gpu, &pipeline.get_bind_group_layout(0), &scratch.uniforms)?;
            ready.push((pipeline, group, (first - before) as u32..(end - before) as u32));
        }
        before = after;
    }
    let query = scratch.profiler.as_ref().map(|profiler| profiler.begin_pass_query(LABEL, encoder));
    let timestamp_writes = query.as_ref().and_then(GpuProfilerQuery::render_pass_timestamp_writes);
    let mut pass = begin_raster(encoder, target, piece.first == 0, timestamp_writes);
    for (pipeline, group, vertices) in ready {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(vertices, 0..1);
    }
    drop(pass);
    end_query(encoder, query, scratch);
    Ok(())
}

fn begin_raster<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    target: &RasterTarget,
    clear: bool,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'a> {
    let color = |(view, color): &'_ (wgpu::TextureView, wgpu::Color)| {
        (view.clone(), if clear { wgpu::LoadOp::Clear(*color) } else { wgpu::LoadOp::Load })
    };
    let colors: Vec<_> = target.colors.iter().map(color).collect();
    let attachments: Vec<_> = colors
        .iter()
        .map(|(view, load)| {
            let ops = wgpu::Operations { load: *load, store: wgpu::StoreOp::Store };
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
        })
        .collect();
    let load = if clear { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(LABEL),
        color_attachments: &attachments,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &target.depth,
            depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
