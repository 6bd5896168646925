//! Triangles: a pipeline of a vertex and a fragment shader, and what it draws into.
//!
//! Vertices are read from storage buffers by number, so a draw binds by name like any kernel.
//! Depth is reversed: 1 is near, 0 is nothing.

use std::sync::Mutex;

use wgpu::naga;

use super::bindings::KernelBinding;
use super::cost::Cost;
use super::reflect::{parse, used_bindings};
use super::shaders::Source;
use super::{GpuError, OpenDevice};

pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
pub(super) const LABEL: &str = "triangles";
const FRAGMENT: &str = "fragment";

/// A compiled pair of shaders, or the reason it is none: a [`super::Job`] reports that.
#[derive(Debug)]
pub struct RasterKernel {
    /// Path below `shaders/` without the extension.
    pub name: String,
    pub bindings: Vec<KernelBinding>,
    pub(super) pipeline: Result<wgpu::RenderPipeline, GpuError>,
    /// Per vertex.
    pub(super) cost: Mutex<Cost>,
}

/// Attachments, cleared before the first draw.
#[derive(Clone, Debug)]
pub struct RasterTarget {
    pub colors: Vec<(wgpu::TextureView, wgpu::Color)>,
    /// Of [`DEPTH_FORMAT`].
    pub depth: wgpu::TextureView,
}

impl RasterKernel {
    pub(super) fn compile(
        gpu: &OpenDevice,
        source: Result<Source, GpuError>,
        path: &str,
        (vertex, colors): (&str, &[wgpu::TextureFormat]),
    ) -> Self {
        let compiled = source.and_then(|source| {
            let bindings = reflect(&source, vertex)?;
            Ok((bindings, create_pipeline(gpu, &source, vertex, colors)?))
        });
        let (bindings, pipeline) = match compiled {
            Ok((bindings, pipeline)) => (bindings, Ok(pipeline)),
            Err(error) => (Vec::new(), Err(error)),
        };
        Self { name: path.trim_end_matches(".wgsl").to_owned(), bindings, pipeline, cost: Mutex::default() }
    }
}

fn reflect(source: &Source, vertex: &str) -> Result<Vec<KernelBinding>, GpuError> {
    let refused = |cause| GpuError::Shader { place: source.path.clone(), cause };
    let (module, info) = parse(source)?;
    let find = |name: &str, stage| {
        let found = module.entry_points.iter().position(|entry| entry.name == name && entry.stage == stage);
        found.ok_or_else(|| refused(format!("there is no {stage:?} entry point \"{name}\"")))
    };
    let entries = [find(vertex, naga::ShaderStage::Vertex)?, find(FRAGMENT, naga::ShaderStage::Fragment)?];
    let (bindings, _) = used_bindings(&module, &info, &entries).map_err(refused)?;
    Ok(bindings)
}

fn create_pipeline(
    gpu: &OpenDevice,
    source: &Source,
    vertex: &str,
    colors: &[wgpu::TextureFormat],
) -> Result<wgpu::RenderPipeline, GpuError> {
    gpu.counted(|counters| counters.pipelines += 1);
    let targets: Vec<_> = colors.iter().map(|&format| Some(wgpu::ColorTargetState::from(format))).collect();
    gpu.checked(&source.path, || {
        let module = &gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&source.path),
            source: wgpu::ShaderSource::Wgsl(source.wgsl.as_str().into()),
        });
        let compilation_options = wgpu::PipelineCompilationOptions::default();
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&source.path),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(FRAGMENT),
                compilation_options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    })
}
