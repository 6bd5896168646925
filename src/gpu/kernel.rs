//! A compute kernel: its pipeline, and what reflection of its WGSL says about it.
//!
//! Bindings are found by the names of the shader's variables; nothing is listed twice. Group 0
//! holds what the kernel reads and writes, group 1 the thread range (`shared/threads.wgsl`).

use std::sync::Mutex;

use wgpu::naga;

use super::bindings::KernelBinding;
use super::cost::Cost;
use super::reflect::{ENTRY, overrides, parse, used_bindings, workgroup_size};
use super::shaders::Source;
use super::{GpuError, OpenDevice};

/// A compiled kernel, or the reason it is none: [`super::Job`] reports that when it should run it.
#[derive(Debug)]
pub struct Kernel {
    /// Path below `shaders/` without the extension.
    pub name: String,
    /// After overrides; y and z are 1.
    pub workgroup_size: [u32; 3],
    /// Group 0, as far as the entry point uses it.
    pub bindings: Vec<KernelBinding>,
    pub(super) pipeline: Result<wgpu::ComputePipeline, GpuError>,
    /// Whether the entry point reads the thread range (group 1).
    pub(super) ranged: bool,
    pub(super) cost: Mutex<Cost>,
}

impl Kernel {
    /// `default_size`: of kernels that leave their workgroup size open.
    pub(super) fn compile(
        gpu: &OpenDevice,
        source: Result<Source, GpuError>,
        name: &str,
        (constants, default_size): (&[(&str, f64)], Option<u32>),
    ) -> Self {
        let compiled = source.and_then(|source| {
            let reflection = Reflection::of(&source, constants, default_size)?;
            let pipeline = create_pipeline(gpu, &source, &reflection.constants)?;
            Ok((reflection, pipeline))
        });
        let (reflection, pipeline) = match compiled {
            Ok((reflection, pipeline)) => (reflection, Ok(pipeline)),
            Err(error) => (Reflection::default(), Err(error)),
        };
        Self {
            name: name.to_owned(),
            workgroup_size: reflection.workgroup_size,
            bindings: reflection.bindings,
            ranged: reflection.ranged,
            pipeline,
            cost: Mutex::default(),
        }
    }
}

#[derive(Default)]
struct Reflection {
    workgroup_size: [u32; 3],
    bindings: Vec<KernelBinding>,
    ranged: bool,
    constants: Vec<(String, f64)>,
}

impl Reflection {
    fn of(source: &Source, constants: &[(&str, f64)], default_size: Option<u32>) -> Result<Self, GpuError> {
        let refused = |cause| GpuError::Shader { place: source.path.clone(), cause };
        let (module, info) = parse(source)?;
        let is_entry = |entry: &naga::EntryPoint| entry.name == ENTRY && entry.stage == naga::ShaderStage::Compute;
        let Some(entry) = module.entry_points.iter().position(is_entry) else {
            return Err(refused(format!("there is no compute entry point \"{ENTRY}\"")));
        };
        let mut reflection = Self { constants: overrides(&module, constants, default_size), ..Self::default() };
        (reflection.bindings, reflection.ranged) = used_bindings(&module, &info, &[entry]).map_err(refused)?;
        reflection.workgroup_size = workgroup_size(&module, &info, &reflection.constants).map_err(refused)?;
        match reflection.workgroup_size {
            [_, 1, 1] => Ok(reflection),
            size => Err(refused(format!("workgroup size {size:?} is not a row of threads"))),
        }
    }
}

fn create_pipeline(
    gpu: &OpenDevice,
    source: &Source,
    constants: &[(String, f64)],
) -> Result<wgpu::ComputePipeline, GpuError> {
    let constants: Vec<_> = constants.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    gpu.counted(|counters| counters.pipelines += 1);
    gpu.checked(&source.path, || {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&source.path),
            source: wgpu::ShaderSource::Wgsl(source.wgsl.as_str().into()),
        });
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&source.path),
            layout: None,
            module: &module,
            entry_point: Some(ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            cache: None,
        })
    })
}
