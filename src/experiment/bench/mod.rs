//! What each kernel costs, beside what its memory traffic alone would cost.
//!
//! The floor of a kernel is the bytes it must move over the bandwidth of a copy kernel measured in
//! the same experiment; the ratio says how far above it the kernel is.

mod copy;
pub mod light;
mod rebuild;
mod sampling;
pub mod surfaces;

use std::cell::RefCell;
use std::sync::Arc;

use serde::Serialize;

use super::board::Share;
use super::lab::Lab;
use super::table::Table;
use super::{Cost, Experiment, ExperimentError, LightReport, Subject, SurfaceReport};
use crate::gpu::Gpu;
use crate::settings::View;
use crate::spread::Spread;

/// As the window's picture, for kernels that draw.
const SIZE_PX: [u32; 2] = [1280, 720];

/// What is measured of the kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BenchOptions {
    /// Frames before those that are measured.
    pub warmup: u32,
    /// A whole rebuild, and a picture of the voxels.
    pub rebuild: bool,
    /// Pointers, light and sampling, variant by variant.
    pub light: bool,
    /// Lit surfaces, variant by variant.
    pub surfaces: bool,
}

#[derive(Clone, Serialize)]
pub struct KernelReport {
    pub scene: String,
    pub warmup: u32,
    pub runs: u32,
    pub span: f64,
    pub voxels: u64,
    pub voxelize_ms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copy: Option<Cost>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub kernels: Vec<Cost>,
    /// All kernels but those that draw, per rebuild.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rebuild: Option<Cost>,
    /// From the request to the finished picture, by the clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_wall: Option<Spread>,
    /// What light costs, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light: Option<LightReport>,
    /// What lit surfaces cost, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<SurfaceReport>,
}

/// Kernels over the voxels of a scene, all on one engine. It is called what its first part is.
pub fn bench(gpu: &Arc<Gpu>, mut subject: Subject, options: BenchOptions) -> Experiment {
    subject.settings.method.look.view = View::Voxels;
    subject.settings.shot.size_px = Some(SIZE_PX);
    let prepared = &subject.prepared;
    let report = KernelReport {
        scene: prepared.scene.name.clone(),
        warmup: options.warmup,
        runs: subject.runs,
        span: prepared.grid.span,
        voxels: prepared.voxel_count(),
        voxelize_ms: prepared.voxelize_ms,
        copy: None,
        kernels: Vec::new(),
        rebuild: None,
        frame_wall: None,
        light: None,
        surfaces: None,
    };
    let name = match options {
        BenchOptions { rebuild: true, .. } => "kernels",
        BenchOptions { light: true, .. } => "light",
        _ => "surfaces",
    };
    Experiment::begin(gpu, (name, subject), report, async move |mut lab, report| {
        lab.warmup = options.warmup;
        measure(lab, &report, options).await
    })
}

async fn measure(mut lab: Lab, report: &RefCell<KernelReport>, options: BenchOptions) -> Result<(), ExperimentError> {
    let weight = |is_wanted: bool, weight: f32| if is_wanted { weight } else { 0.0 };
    let has_floors = options.rebuild || options.light;
    // About as they take on the built-in scenes.
    let weights = [(has_floors, 1.0), (options.rebuild, 2.0), (options.light, 15.0), (options.surfaces, 30.0)];
    let [copying, rebuilding, lighting, drawing] =
        Share::WHOLE.split(weights.map(|(is_wanted, size)| weight(is_wanted, size)));
    if has_floors {
        let copy = copy::measure(&lab, copying).await?;
        let bytes_per_ms = copy.bytes as f64 / copy.time.median_ms;
        report.borrow_mut().copy = Some(copy);
        if options.rebuild {
            rebuild::measure(&mut lab, report, (rebuilding, bytes_per_ms)).await?;
        }
        if options.light {
            light::measure(&mut lab, report, (lighting, bytes_per_ms)).await?;
        }
    }
    if options.surfaces {
        surfaces::measure(&mut lab, report, drawing).await?;
    }
    Ok(())
}

impl KernelReport {
    pub(super) fn tables(&self) -> Vec<Table> {
        let costs = self.kernels.iter().chain(&self.rebuild).chain(&self.copy);
        let kernels = Table::new("kernels", &Cost::HEADS, costs.map(Cost::cells));
        let more = self.light.iter().flat_map(LightReport::tables);
        let kernels = Some(kernels).filter(|table| !table.rows.is_empty());
        kernels.into_iter().chain(more).chain(self.surfaces.iter().map(SurfaceReport::table)).collect()
    }
}
