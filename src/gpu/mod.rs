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
mod lock;
mod memory;
mod mirror;
mod opening;
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
use std::ops::Deref;
use std::sync::{Arc, Mutex};

pub use bindings::{BindingKind, KernelBinding};
pub use buffer::GpuBuffer;
pub(crate) use constant::constants;
pub use constant::{Constant, Number};
pub use cost::KernelTiming;
pub use counted::Counted;
pub use device::{Counters, OpenDevice};
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

use lock::lock;

/// One device, and what was compiled for it.
pub struct Gpu {
    open: OpenDevice,
    shaders: &'static Shaders,
    default_workgroup_size: Option<u32>,
    /// Texts that stand for files of `shaders/`.
    replaced: BTreeMap<String, String>,
    kernels: Mutex<HashMap<KernelKey, Arc<Kernel>>>,
    raster_kernels: Mutex<HashMap<(&'static str, &'static str), Arc<RasterKernel>>>,
    scratch: Mutex<Vec<scratch::Scratch>>,
}

/// Path and overrides (as bits, which are comparable).
type KernelKey = (String, Vec<(String, u64)>);

/// What needs no kernel, the device does itself.
impl Deref for Gpu {
    type Target = OpenDevice;

    fn deref(&self) -> &OpenDevice {
        &self.open
    }
}

impl Gpu {
    /// The kernel of `shaders/PATH` with these overrides, compiled on first need. A kernel that
    /// does not compile is returned too; running it is the error.
    pub fn kernel(&self, path: &'static str, constants: &[(&str, f64)]) -> Arc<Kernel> {
        let overrides = constants.iter().map(|(name, value)| ((*name).to_owned(), value.to_bits())).collect();
        let mut kernels = lock(&self.kernels);
        let kernel = kernels.entry((path.to_owned(), overrides)).or_insert_with(|| {
            let name = path.trim_end_matches(".wgsl");
            self.compile(self.source(path), name, constants)
        });
        Arc::clone(kernel)
    }

    fn source(&self, path: &str) -> Result<Source, GpuError> {
        self.replaced.get(path).map_or_else(|| self.shaders.embedded(path), |wgsl| self.shaders.inline(path, wgsl))
    }

    /// A kernel from text, which may import files of `shaders/`. Not cached.
    pub fn kernel_from_source(&self, name: &str, wgsl: &str, constants: &[(&str, f64)]) -> Arc<Kernel> {
        self.compile(self.shaders.inline(name, wgsl), name, constants)
    }

    fn compile(&self, source: Result<Source, GpuError>, name: &str, constants: &[(&str, f64)]) -> Arc<Kernel> {
        Arc::new(Kernel::compile(self, source, name, (constants, self.default_workgroup_size)))
    }

    /// The triangle shaders of `shaders/PATH`: vertex entry point `vertex`, fragment entry point
    /// `fragment`. Compiled on first need.
    pub fn raster_kernel(
        &self,
        path: &'static str,
        vertex: &'static str,
        colors: &[wgpu::TextureFormat],
    ) -> Arc<RasterKernel> {
        let mut kernels = lock(&self.raster_kernels);
        let compile = || RasterKernel::compile(self, self.shaders.embedded(path), path, (vertex, colors));
        Arc::clone(kernels.entry((path, vertex)).or_insert_with(|| Arc::new(compile())))
    }
}
