//! What experiments tell: the rows of each, and the tables made of them.

mod discretizers;
mod kernels;
mod light;
mod race;
mod rendering;
mod shadows;
mod surfaces;
mod voxels;

pub use discretizers::{DiscretizerReport, DiscretizerRow};
pub use kernels::KernelReport;
pub use light::{LightReport, MemoryReport, SamplingCost};
pub use race::{PathsError, Race};
pub use rendering::{RenderingRow, paths_in_that_time};
pub(super) use shadows::Method;
pub use shadows::ShadowRow;
pub use surfaces::{SurfaceReport, VariantCost};
pub use voxels::VoxelRow;
