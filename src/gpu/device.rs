//! Opening a device, and noticing when it fails.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};

use super::reflect::causes;
use super::{Counters, Gpu, GpuError, Shaders, lock};

/// Older ones end a shader's loops after 65 535 iterations without a word.
const MIN_MESA_MAJOR: u32 = 24;

/// What the device said outside of any call that waits for an answer.
#[derive(Debug, Default)]
pub(super) struct Health {
    lost: Mutex<Option<String>>,
    error: Mutex<Option<String>>,
}

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
        let health = Arc::new(Health::default());
        let on_lost = Arc::clone(&health);
        device.set_device_lost_callback(move |reason, message| {
            *lock(&on_lost.lost) = Some(format!("{reason:?}, {message}"));
        });
        let on_error = Arc::clone(&health);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let cause = one_line(&error);
            log::error!("GPU: {cause}");
            *lock(&on_error.error) = Some(cause);
        }));
        Self {
            info: adapter.get_info(),
            limits: device.limits(),
            device,
            queue,
            shaders,
            default_workgroup_size: None,
            replaced: BTreeMap::new(),
            kernels: Mutex::default(),
            raster_kernels: Mutex::default(),
            registry: Arc::default(),
            serial: AtomicU64::default(),
            counters: Mutex::new(Counters::default()),
            scratch: Mutex::default(),
            health,
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
            device: self.device.clone(),
            queue: self.queue.clone(),
            info: self.info.clone(),
            limits: self.limits.clone(),
            shaders: self.shaders,
            default_workgroup_size: self.default_workgroup_size,
            replaced: BTreeMap::from([(path.to_owned(), wgsl.to_owned())]),
            kernels: Mutex::default(),
            raster_kernels: Mutex::default(),
            registry: Arc::default(),
            serial: AtomicU64::default(),
            counters: Mutex::default(),
            scratch: Mutex::default(),
            health: Arc::clone(&self.health),
        }
    }

    /// What a person should know about this adapter, a sentence each.
    pub fn warnings(&self) -> Vec<String> {
        let old = mesa_major(&self.info).filter(|major| self.is_software() && *major < MIN_MESA_MAJOR);
        let sentence = |major| {
            format!(
                "Mesa {major} ends long shader loops after 65535 iterations, so voxels may be lost; \
                 install Mesa {MIN_MESA_MAJOR} or newer"
            )
        };
        old.map(sentence).into_iter().collect()
    }

    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The device is gone; a new [`Gpu`] is needed.
    pub fn is_lost(&self) -> bool {
        lock(&self.health.lost).is_some()
    }

    /// Lost device or an error nobody waited for; the latter is told once.
    pub(super) fn check_health(&self) -> Result<(), GpuError> {
        if let Some(cause) = lock(&self.health.lost).clone() {
            return Err(GpuError::Lost(cause));
        }
        match lock(&self.health.error).take() {
            Some(cause) => Err(self.lost_or_refused("a command", &cause)),
            None => Ok(()),
        }
    }

    /// A lost device refuses everything, and its loss is told only to who polls: then the loss is what
    /// went wrong.
    fn lost_or_refused(&self, what: &str, cause: &str) -> GpuError {
        // What else this returns is of no use here.
        let _ = self.device.poll(wgpu::PollType::Poll);
        match lock(&self.health.lost).clone() {
            Some(cause) => GpuError::Lost(cause),
            None => self.refused(what, cause),
        }
    }

    /// Lets callbacks of finished work run.
    pub(super) fn poll(&self) -> Result<(), GpuError> {
        let polled = self.device.poll(wgpu::PollType::Poll);
        polled.map_err(|error| self.refused("waiting", &error.to_string())).and_then(|_| self.check_health())
    }

    /// Blocks until everything submitted is done.
    pub fn wait(&self) -> Result<(), GpuError> {
        let waited = self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: None });
        waited.map_err(|error| self.lost_or_refused("waiting", &error.to_string())).and_then(|_| self.check_health())
    }

    /// Runs calls of wgpu; what they report becomes an error instead of a panic.
    pub(super) fn checked<T>(&self, what: &str, calls: impl FnOnce() -> T) -> Result<T, GpuError> {
        use wgpu::ErrorFilter::{Internal, OutOfMemory, Validation};
        self.check_health()?;
        let memory = self.device.push_error_scope(OutOfMemory);
        let internal = self.device.push_error_scope(Internal);
        let validation = self.device.push_error_scope(Validation);
        let result = calls();
        let errors = [validation.pop(), internal.pop(), memory.pop()].map(pollster::block_on);
        match errors.into_iter().flatten().next() {
            Some(error) => Err(self.lost_or_refused(what, &one_line(&error))),
            None => Ok(result),
        }
    }

    pub(super) fn refused(&self, what: &str, cause: &str) -> GpuError {
        GpuError::Refused { what: what.to_owned(), cause: cause.to_owned() }
    }
}

/// wgpu indents what caused an error on lines of their own.
fn one_line(error: &wgpu::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
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
        let names: Vec<_> = adapters.iter().map(|adapter| format!("\"{}\"", adapter.get_info().name)).collect();
        GpuError::NoAdapter {
            wanted: name.map_or_else(String::new, |name| format!(" has \"{name}\" in its name")),
            found: match names.len() {
                0 => "install a Vulkan driver (Mesa 24 or newer, or the vendor's)".to_owned(),
                _ => format!("there are: {}", names.join(", ")),
            },
        }
    })
}

/// The 25 of "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)".
fn mesa_major(info: &wgpu::AdapterInfo) -> Option<u32> {
    let version = info.driver_info.split("Mesa ").nth(1)?;
    version.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}
