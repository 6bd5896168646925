//! Opening a device: which adapter, and what is asked of it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

use super::device::OpenDevice;
use super::reflect::causes;
use super::{Gpu, GpuError, Shaders};

impl Gpu {
    /// A device without a window: the best adapter, or the first whose name contains
    /// `adapter_name` (case does not matter).
    pub fn headless(shaders: &'static Shaders, adapter_name: Option<&str>) -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let adapter = &Self::choose_adapter(adapters, adapter_name)?;
        let descriptor = Self::device_descriptor(adapter);
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) =
            opened.map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, cause: causes(&error) })?;
        Ok(Self::from_wgpu(shaders, adapter, device, queue))
    }

    /// The best of these adapters, or the first whose name contains `name` (case does not matter).
    pub fn choose_adapter(mut adapters: Vec<wgpu::Adapter>, name: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
        adapters.retain(|adapter| {
            adapter.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS)
        });
        adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
        choose(&adapters, name).cloned()
    }

    /// Takes over a device that somebody else opened, best with [`Gpu::device_descriptor`].
    pub fn from_wgpu(
        shaders: &'static Shaders,
        adapter: &wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Self {
        Self {
            open: OpenDevice::new(adapter, device, queue),
            shaders,
            default_workgroup_size: None,
            replaced: BTreeMap::new(),
            kernels: Mutex::default(),
            raster_kernels: Mutex::default(),
            scratch: Mutex::default(),
        }
    }

    /// What the program asks of a device: wgpu's default limits, buffers and images as large as the
    /// adapter allows, and timestamps where there are any.
    pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        use wgpu::Features;
        let timestamps = Features::TIMESTAMP_QUERY
            | Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
            | Features::TIMESTAMP_QUERY_INSIDE_PASSES;
        let offered = adapter.limits();
        wgpu::DeviceDescriptor {
            label: Some("octolume"),
            required_features: adapter.features() & timestamps,
            required_limits: wgpu::Limits {
                max_buffer_size: offered.max_buffer_size,
                max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
                max_texture_dimension_2d: offered.max_texture_dimension_2d,
                ..wgpu::Limits::default().or_worse_values_from(&offered)
            },
            ..Default::default()
        }
    }

    /// Kernels that declare `WORKGROUP_SIZE` get this one, unless asked for another.
    pub fn with_workgroup_size(mut self, threads: u32) -> Self {
        self.default_workgroup_size = Some(threads);
        self
    }

    /// Another on the same device, where `wgsl` stands for the compute kernel `shaders/PATH`: for trying a change.
    /// Buffers and textures of each serve both.
    pub fn with_shader(&self, path: &str, wgsl: &str) -> Self {
        Self {
            open: self.open.counted_anew(),
            shaders: self.shaders,
            default_workgroup_size: self.default_workgroup_size,
            replaced: BTreeMap::from([(path.to_owned(), wgsl.to_owned())]),
            kernels: Mutex::default(),
            raster_kernels: Mutex::default(),
            scratch: Mutex::default(),
        }
    }
}

/// Real GPUs first, large ones before small ones.
fn rank(info: &wgpu::AdapterInfo) -> (u8, bool) {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    (kind, info.backend == wgpu::Backend::Gl)
}

fn choose<'a>(adapters: &'a [wgpu::Adapter], name: Option<&str>) -> Result<&'a wgpu::Adapter, GpuError> {
    let wanted = name.unwrap_or_default().to_lowercase();
    let chosen = adapters.iter().find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted));
    chosen.ok_or_else(|| {
        // One adapter may be there through several drivers.
        let names: BTreeSet<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
        let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        GpuError::NoAdapter {
            wanted: name.map_or_else(String::new, |name| format!(" has \"{name}\" in its name")),
            found: match names.len() {
                0 => "install a Vulkan driver (Mesa 24 or newer, or the vendor's)".to_owned(),
                _ => format!("there are: {}", names.join(", ")),
            },
        }
    })
}
