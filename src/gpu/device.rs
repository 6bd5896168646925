//! An open device: what it is, what lives on it, and what goes wrong on it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::GpuError;
use super::lock::lock;
use super::memory::{BufferUse, Memory, Reserved};

/// Older ones end a shader's loops after 65 535 iterations without a word.
const MIN_MESA_MAJOR: u32 = 24;

/// What the device said outside of any call that waits for an answer.
#[derive(Debug, Default)]
struct Health {
    lost: Mutex<Option<String>>,
    error: Mutex<Option<String>>,
}

/// What was done since the start; a plan is checked against the differences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Recorded passes that ran, by kernel name, however many slices each took.
    pub dispatches: BTreeMap<String, u64>,
    pub pipelines: u64,
    pub buffers: u64,
}

/// All that needs no kernel.
pub struct OpenDevice {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    pub limits: wgpu::Limits,
    memory: Memory,
    counters: Mutex<Counters>,
    health: Arc<Health>,
}

impl OpenDevice {
    pub(super) fn new(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
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
        let (memory, counters) = (Memory::default(), Mutex::default());
        Self { info: adapter.get_info(), limits: device.limits(), device, queue, memory, counters, health }
    }

    /// The same device, with nothing counted yet.
    pub(super) fn counted_anew(&self) -> Self {
        Self {
            device: self.device.clone(),
            queue: self.queue.clone(),
            info: self.info.clone(),
            limits: self.limits.clone(),
            memory: Memory::default(),
            counters: Mutex::default(),
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

    /// It is gone; a new [`super::Gpu`] is needed.
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

    pub fn counters(&self) -> Counters {
        lock(&self.counters).clone()
    }

    pub(super) fn counted(&self, count: impl FnOnce(&mut Counters)) {
        count(&mut lock(&self.counters));
    }

    /// Live buffers and textures in the order they were made.
    pub fn memory(&self) -> Vec<BufferUse> {
        self.memory.uses()
    }

    /// Bytes of all of them.
    pub fn bytes_in_use(&self) -> u64 {
        self.memory.bytes()
    }

    /// From here on, what would bring them beyond so many bytes is refused; `None`: the device decides.
    pub fn limit_memory(&self, bytes: Option<u64>) {
        self.memory.limit(bytes);
    }

    /// Runs the call of wgpu that makes something of so many bytes; without memory for it the error says so.
    pub(super) fn allocated<T>(&self, label: &str, bytes: u64, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        self.checked(label, make).map_err(|error| match error {
            GpuError::Refused { cause, .. } => GpuError::OutOfMemory { label: label.to_owned(), bytes, cause },
            error => error,
        })
    }

    /// Counts in what is made next.
    pub(super) fn reserve(&self, label: &str, bytes: u64) -> Result<Reserved, GpuError> {
        self.memory.reserve(label, bytes)
    }
}

/// wgpu indents what caused an error on lines of their own.
fn one_line(error: &wgpu::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The 25 of "Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6)".
fn mesa_major(info: &wgpu::AdapterInfo) -> Option<u32> {
    let version = info.driver_info.split("Mesa ").nth(1)?;
    version.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}
