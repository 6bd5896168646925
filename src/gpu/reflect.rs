//! What naga says about a shader: the bindings its entry points use, its overrides, its workgroup.

use wgpu::naga;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::GpuError;
use super::bindings::{BindingKind, KernelBinding};
use super::shaders::Source;

pub(super) const ENTRY: &str = "main";
const WORKGROUP_SIZE: &str = "WORKGROUP_SIZE";

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

/// Group 0 as far as these entry points use it, and whether they use the thread range of group 1.
pub(super) fn used_bindings(
    module: &naga::Module,
    info: &ModuleInfo,
    entries: &[usize],
) -> Result<(Vec<KernelBinding>, bool), String> {
    let (mut bindings, mut ranged) = (Vec::new(), false);
    for (handle, variable) in module.global_variables.iter() {
        let used = entries.iter().any(|&entry| !info.get_entry_point(entry)[handle].is_empty());
        let Some(place) = variable.binding.filter(|_| used) else { continue };
        let name = variable.name.clone().unwrap_or_default();
        let (group, binding) = (place.group, place.binding);
        match group {
            0 => bindings.push(KernelBinding { name, binding, kind: kind(module, variable) }),
            1 if binding == 0 => ranged = true,
            _ => return Err(format!("\"{name}\" is in group {group}, binding {binding}")),
        }
    }
    Ok((bindings, ranged))
}

/// Overrides as asked for, and the workgroup size where the device has a default.
pub(super) fn overrides(
    module: &naga::Module,
    constants: &[(&str, f64)],
    default_size: Option<u32>,
) -> Vec<(String, f64)> {
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

/// After overrides.
pub(super) fn workgroup_size(
    module: &naga::Module,
    info: &ModuleInfo,
    constants: &[(String, f64)],
) -> Result<[u32; 3], String> {
    let constants = constants.iter().cloned().collect();
    let entry = Some((naga::ShaderStage::Compute, ENTRY));
    let (module, _) = naga::back::pipeline_constants::process_overrides(module, info, entry, &constants)
        .map_err(|error| causes(&error))?;
    Ok(module.entry_points.first().map_or([0; 3], |entry| entry.workgroup_size))
}
