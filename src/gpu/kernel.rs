//! A compute kernel: its pipeline, and what reflection of its WGSL says about it.
//!
//! Bindings are found by the names of the shader's variables; nothing is listed twice. Group 0
//! holds what the kernel reads and writes, group 1 the thread range (`shared/threads.wgsl`).

use std::sync::Mutex;

use wgpu::naga;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::cost::Cost;
use super::shaders::Source;
use super::{Gpu, GpuError};

pub(super) const WORKGROUP_SIZE: &str = "WORKGROUP_SIZE";
const ENTRY: &str = "main";

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

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelBinding {
    pub name: String,
    pub binding: u32,
    pub kind: BindingKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    Uniform,
    Storage { read_only: bool },
    Texture,
    Sampler,
}

impl Kernel {
    pub(super) fn compile(gpu: &Gpu, source: Result<Source, GpuError>, name: &str, constants: &[(&str, f64)]) -> Self {
        let compiled = source.and_then(|source| {
            let reflection = Reflection::of(&source, constants, gpu.default_workgroup_size)?;
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

    pub(super) fn binding(&self, name: &str) -> Option<&KernelBinding> {
        self.bindings.iter().find(|binding| binding.name == name)
    }
}

/// Parses and validates WGSL; errors name file and line.
pub fn parse(source: &Source) -> Result<(naga::Module, ModuleInfo), GpuError> {
    let refused = |location: Option<naga::SourceLocation>, cause: String| GpuError::Shader {
        place: location.map_or(source.path.clone(), |location| source.place(location.line_number as usize)),
        cause,
    };
    let module = naga::front::wgsl::parse_str(&source.wgsl)
        .map_err(|error| refused(error.location(&source.wgsl), error.message().to_owned()))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::default());
    let info =
        validator.validate(&module).map_err(|error| refused(error.location(&source.wgsl), causes(error.as_inner())))?;
    Ok((module, info))
}

/// An error and what caused it, in one line.
pub(super) fn causes(error: &dyn std::error::Error) -> String {
    let chain = std::iter::successors(Some(error), |error| error.source());
    chain.map(|error| error.to_string().trim().replace('\n', " ")).collect::<Vec<_>>().join(": ")
}

#[derive(Default)]
struct Reflection {
    workgroup_size: [u32; 3],
    bindings: Vec<KernelBinding>,
    ranged: bool,
    /// Overrides as asked for, and the workgroup size where the device has a default.
    constants: Vec<(String, f64)>,
}

impl Reflection {
    fn of(source: &Source, constants: &[(&str, f64)], default_size: Option<u32>) -> Result<Self, GpuError> {
        let refused = |cause: String| GpuError::Shader { place: source.path.clone(), cause };
        let (module, info) = parse(source)?;
        let is_entry = |entry: &naga::EntryPoint| entry.name == ENTRY && entry.stage == naga::ShaderStage::Compute;
        let Some(entry) = module.entry_points.iter().position(is_entry) else {
            return Err(refused(format!("there is no compute entry point \"{ENTRY}\"")));
        };
        let mut reflection = Self { constants: overrides(&module, constants, default_size), ..Self::default() };
        let uses = info.get_entry_point(entry);
        for (_, variable) in module.global_variables.iter().filter(|(handle, _)| !uses[*handle].is_empty()) {
            let Some(place) = variable.binding else { continue };
            let name = variable.name.clone().unwrap_or_default();
            let (group, binding) = (place.group, place.binding);
            match group {
                0 => reflection.bindings.push(KernelBinding { name, binding, kind: kind(&module, variable) }),
                1 if binding == 0 => reflection.ranged = true,
                _ => return Err(refused(format!("\"{name}\" is in group {group}, binding {binding}"))),
            }
        }
        reflection.workgroup_size = workgroup_size(&module, &info, &reflection.constants).map_err(&refused)?;
        match reflection.workgroup_size {
            [_, 1, 1] => Ok(reflection),
            size => Err(refused(format!("workgroup size {size:?} is not a row of threads"))),
        }
    }
}

fn overrides(module: &naga::Module, constants: &[(&str, f64)], default_size: Option<u32>) -> Vec<(String, f64)> {
    let mut all: Vec<_> = constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let declared = module.overrides.iter().any(|(_, o)| o.name.as_deref() == Some(WORKGROUP_SIZE));
    if let Some(size) = default_size
        && declared
        && all.iter().all(|(name, _)| name != WORKGROUP_SIZE)
    {
        all.push((WORKGROUP_SIZE.to_owned(), f64::from(size)));
    }
    all
}

fn kind(module: &naga::Module, variable: &naga::GlobalVariable) -> BindingKind {
    match variable.space {
        naga::AddressSpace::Uniform => BindingKind::Uniform,
        naga::AddressSpace::Storage { access } => {
            BindingKind::Storage { read_only: !access.contains(naga::StorageAccess::STORE) }
        }
        _ if matches!(module.types[variable.ty].inner, naga::TypeInner::Sampler { .. }) => BindingKind::Sampler,
        _ => BindingKind::Texture,
    }
}

fn workgroup_size(module: &naga::Module, info: &ModuleInfo, constants: &[(String, f64)]) -> Result<[u32; 3], String> {
    let constants = constants.iter().cloned().collect();
    let entry = Some((naga::ShaderStage::Compute, ENTRY));
    let (module, _) = naga::back::pipeline_constants::process_overrides(module, info, entry, &constants)
        .map_err(|error| causes(&error))?;
    Ok(module.entry_points.first().map_or([0; 3], |entry| entry.workgroup_size))
}

fn create_pipeline(gpu: &Gpu, source: &Source, constants: &[(String, f64)]) -> Result<wgpu::ComputePipeline, GpuError> {
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
