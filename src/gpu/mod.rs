//! GPU plumbing: device, shaders, kernels by reflection, buffers, recorded work run in slices.
//!
//! ```text
//! shaders/x.wgsl ─► Source ─► Kernel ─┐
//!                         GpuBuffer ──┴► Recorder ─► Job ─► slices of the queue ─► KernelTiming, bytes
//! ```
//!
//! A stage *records* what it wants done; nothing runs until a [`Job`] runs it, in pieces short
//! enough that a window on the same queue stays fluid. Nothing here knows the paper.

mod bindings;
mod buffer;
mod command;
mod constant;
mod cost;
mod counted;
mod counts;
mod device;
mod encode;
mod encode_raster;
mod error;
mod job;
mod kernel;
mod memory;
mod mirror;
mod pass;
mod raster;
mod read_back;
mod reading;
mod recorder;
mod reflect;
mod scratch;
mod shaders;
mod texture;

use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

pub use bindings::{BindingKind, KernelBinding};
pub use buffer::GpuBuffer;
pub(crate) use constant::constants;
pub use constant::{Constant, Number};
pub use cost::KernelTiming;
pub use counted::Counted;
pub use encode::{MIRRORS, Threads};
pub use error::GpuError;
pub use job::{Job, JobState};
pub use kernel::Kernel;
pub use memory::BufferUse;
pub use mirror::Mirror;
pub(crate) use mirror::mirror;
pub use pass::PassBuilder;
pub use raster::{DEPTH_FORMAT, RasterKernel, RasterTarget};
pub use reading::PendingRead;
pub use recorder::{Recorder, Uniform};
pub use reflect::parse;
pub use shaders::{Shaders, Source};
pub use texture::GpuTexture;

use device::Health;

/// One device, what was compiled for it and what lives on it.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    pub limits: wgpu::Limits,
    shaders: &'static Shaders,
    default_workgroup_size: Option<u32>,
    /// Texts that stand for files of `shaders/`.
    replaced: BTreeMap<String, String>,
    kernels: Mutex<HashMap<KernelKey, Arc<Kernel>>>,
    raster_kernels: Mutex<HashMap<(&'static str, &'static str), Arc<RasterKernel>>>,
    registry: memory::Registry,
    serial: AtomicU64,
    counters: Mutex<Counters>,
    scratch: Mutex<Vec<scratch::Scratch>>,
    health: Arc<Health>,
}

/// Path and overrides (as bits, which are comparable).
type KernelKey = (String, Vec<(String, u64)>);

/// What was done since the start; a plan is checked against the differences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Recorded passes that ran, by kernel name, however many slices each took.
    pub dispatches: BTreeMap<String, u64>,
    pub pipelines: u64,
    pub buffers: u64,
}

impl Gpu {
    /// The kernel of `shaders/PATH` with these overrides, compiled on first need. A kernel that
    /// does not compile is returned too; running it is the error.
    pub fn kernel(&self, path: &'static str, constants: &[(&str, f64)]) -> Arc<Kernel> {
        let overrides = constants.iter().map(|(name, value)| ((*name).to_owned(), value.to_bits())).collect();
        let mut kernels = lock(&self.kernels);
        let kernel = kernels.entry((path.to_owned(), overrides)).or_insert_with(|| {
            let name = path.trim_end_matches(".wgsl");
            Arc::new(Kernel::compile(self, self.source(path), name, constants))
        });
        Arc::clone(kernel)
    }

    fn source(&self, path: &str) -> Result<Source, GpuError> {
        self.replaced.get(path).map_or_else(|| self.shaders.embedded(path), |wgsl| self.shaders.inline(path, wgsl))
    }

    /// A kernel from text, which may import files of `shaders/`. Not cached.
    pub fn kernel_from_source(&self, name: &str, wgsl: &str, constants: &[(&str, f64)]) -> Arc<Kernel> {
        Arc::new(Kernel::compile(self, self.shaders.inline(name, wgsl), name, constants))
    }

    pub fn counters(&self) -> Counters {
        lock(&self.counters).clone()
    }

    fn counted(&self, count: impl FnOnce(&mut Counters)) {
        count(&mut lock(&self.counters));
    }
}

/// A panic in another thread leaves these plain collections usable.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
