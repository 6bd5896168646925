//! What each kernel costs, beside what its memory traffic alone would cost.
//!
//! The floor of a kernel is the bytes it must move over the bandwidth of a copy kernel measured in
//! the same experiment; the ratio says how far above it the kernel is.

pub mod copy;
pub mod copy_ref;
pub mod discretizers;
mod light;
mod rebuild;
mod sampling;
mod surfaces;

use std::sync::Arc;

use super::board::{Findings, Share};
use super::lab::{Lab, PICTURE_PX};
use super::rows::KernelReport;
use super::{Experiment, ExperimentError, Subject};
use crate::gpu::Gpu;
use crate::settings::View;

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

/// Kernels over the voxels of a scene, all on one engine. It is called what its first part is.
pub fn bench(gpu: &Arc<Gpu>, mut subject: Subject, options: BenchOptions) -> Experiment {
    subject.settings.method.look.view = View::Voxels;
    subject.settings.shot.size_px = Some(PICTURE_PX);
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

async fn measure(mut lab: Lab, report: &Findings<KernelReport>, options: BenchOptions) -> Result<(), ExperimentError> {
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
