//! `octolume bench`: what each kernel costs, beside what its memory traffic alone would cost.
//!
//! The floor of a kernel is the bytes it must move over the bandwidth of a copy kernel measured in
//! the same run; the ratio says how far above it the kernel is.

mod cost;
mod light;
mod sampling;
mod surfaces;

use std::path::PathBuf;
use std::time::{Instant, SystemTime};

use anyhow::Context;
use clap::Args;
use octolume::gpu::{Gpu, Job, KernelTiming, Recorder};
use octolume::settings::{Settings, View};
use octolume::stages::bench::copy;
use serde::Serialize;
use wgpu::BufferUsages;

use cost::{Cost, HEADS, Samples};
use light::LightReport;
use surfaces::SurfaceReport;

use super::options::{Common, Moment};
use super::session::Session;
use super::{Usage, output};
use octolume::spread::Spread;

/// As the window's picture, for the view kernel.
const SIZE_PX: [u32; 2] = [1280, 720];
/// What the copy kernel copies: more than caches hold, within wgpu's default limits.
const COPY_BYTES: u64 = 128 << 20;
/// Folder of the kernels that draw; the others rebuild.
const VIEW_KERNELS: &str = "view/";

/// Measures every kernel of a whole rebuild, and a copy kernel beside them
#[derive(Debug, Args)]
pub struct Bench {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// Prints JSON
    #[arg(long)]
    json: bool,
    /// Measures pointers, light and sampling too, variant by variant
    #[arg(long)]
    lighting: bool,
    /// Measures lit surfaces too, variant by variant
    #[arg(long)]
    surfaces: bool,
    /// Rebuilds before anything is measured
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    warmup: u32,
    /// Rebuilds measured
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    runs: u32,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

#[derive(Serialize)]
struct Report {
    scene: String,
    octolume: &'static str,
    date: String,
    adapter: String,
    driver: String,
    warmup: u32,
    runs: u32,
    settings: Settings,
    span: f64,
    voxels: u64,
    voxelize_ms: f64,
    copy: Cost,
    kernels: Vec<Cost>,
    /// All kernels but those that draw, per rebuild.
    rebuild: Cost,
    /// From the request to the finished picture, by the clock.
    frame_wall: Spread,
    /// What light costs, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<LightReport>,
    /// What lit surfaces cost, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    surfaces: Option<SurfaceReport>,
}

impl Bench {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        settings.look.view = View::Voxels;
        settings.check().map_err(Usage)?;
        // Voxelization is measured too, so its results are not looked for on the disk.
        let mut session = Session::open_with(&self.scene, &self.common, None, &mut settings)?;
        let report = self.measure(&mut session, settings)?;
        if self.json { output::json(&report) } else { output::result(&report.text()) }
    }
}

impl Bench {
    fn measure(&self, session: &mut Session, settings: Settings) -> anyhow::Result<Report> {
        let copy = self.measure_copy(session.engine.gpu())?;
        let bytes_per_ms = copy.bytes as f64 / copy.time.median_ms;
        let mut kernels: Vec<(String, Samples)> = Vec::new();
        let mut rebuild = Samples::default();
        let mut frame_ms = Vec::new();
        for run in 0..self.warmup + self.runs {
            let (timings, wall_ms) = rebuild_once(session, &settings)?;
            if run >= self.warmup {
                add_run(&mut kernels, &mut rebuild, &timings);
                frame_ms.push(wall_ms);
            }
        }
        let cost = |(kernel, samples): (String, Samples)| samples.cost(kernel, bytes_per_ms);
        let light = if self.lighting {
            Some(light::measure(session, &settings, (self.warmup, self.runs), bytes_per_ms)?)
        } else {
            None
        };
        let surfaces = match self.surfaces {
            true => Some(surfaces::measure(session, &settings, (self.warmup, self.runs))?),
            false => None,
        };
        let info = &session.engine.gpu().info;
        Ok(Report {
            scene: session.prepared.scene.name.clone(),
            octolume: env!("CARGO_PKG_VERSION"),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            adapter: info.name.clone(),
            driver: format!("{} {}", info.driver, info.driver_info),
            warmup: self.warmup,
            runs: self.runs,
            span: session.prepared.grid.span,
            voxels: session.prepared.voxel_count(),
            voxelize_ms: session.prepared.voxelize_ms,
            rebuild: cost(("rebuild".to_owned(), rebuild)).context("no kernel ran")?,
            kernels: kernels.into_iter().filter_map(cost).collect(),
            frame_wall: Spread::of(&frame_ms).context("no run was measured")?,
            light,
            surfaces,
            copy,
            settings,
        })
    }

    fn measure_copy(&self, gpu: &Gpu) -> anyhow::Result<Cost> {
        let bytes = COPY_BYTES.min(gpu.limits.max_storage_buffer_binding_size);
        let original = gpu.buffer("bench original", bytes, BufferUsages::empty())?;
        let duplicate = gpu.buffer("bench duplicate", bytes, BufferUsages::empty())?;
        let mut samples = Samples { ms: Vec::new(), bytes: 2 * bytes };
        for run in 0..self.warmup + self.runs {
            let mut recorder = Recorder::default();
            copy::record(gpu, &mut recorder, &original, &duplicate, bytes);
            let ms = Job::new(recorder).run_to_end(gpu)?.iter().map(|timing| timing.ms).sum();
            if run >= self.warmup {
                samples.ms.push(ms);
            }
        }
        let spread = Spread::of(&samples.ms).context("no run was measured")?;
        samples.cost("bench/copy".to_owned(), samples.bytes as f64 / spread.median_ms).context("no run was measured")
    }
}

/// Everything anew; the kernels' times and the time by the clock.
fn rebuild_once(session: &mut Session, settings: &Settings) -> anyhow::Result<(Vec<KernelTiming>, f64)> {
    session.engine.invalidate();
    let started = Instant::now();
    session.run(settings, SIZE_PX)?;
    let wall_ms = started.elapsed().as_secs_f64() * 1e3;
    Ok((session.kernel_times(), wall_ms))
}

/// Adds the dispatches of one rebuild up, by kernel and over all that do not draw.
fn add_run(kernels: &mut Vec<(String, Samples)>, rebuild: &mut Samples, timings: &[KernelTiming]) {
    let mut names: Vec<&str> = Vec::new();
    timings.iter().map(|timing| timing.kernel.as_str()).for_each(|name| {
        if !names.contains(&name) {
            names.push(name);
        }
    });
    for name in names {
        let place = kernels.iter().position(|(kernel, _)| kernel == name).unwrap_or_else(|| {
            kernels.push((name.to_owned(), Samples::default()));
            kernels.len() - 1
        });
        kernels[place].1.add(timings.iter().filter(|timing| timing.kernel == name));
    }
    rebuild.add(timings.iter().filter(|timing| !timing.kernel.starts_with(VIEW_KERNELS)));
}

impl Report {
    fn text(&self) -> String {
        let all = self.kernels.iter().chain([&self.rebuild, &self.copy]);
        let table = output::table(&HEADS, all.map(Cost::row));
        let wall = &self.frame_wall;
        let parts = [self.light.as_ref().map(LightReport::text), self.surfaces.as_ref().map(SurfaceReport::text)];
        let more: String = parts.into_iter().flatten().map(|part| format!("\n\n{part}")).collect();
        format!(
            "{} at {} cells of {} units, {} voxels, on {} ({}), {}\n\n{table}\n\n\
             voxelized once in {:.0} ms; a frame by the clock: {:.1} ms ({:.1} to {:.1}){more}",
            self.scene,
            self.settings.discretization.grid,
            self.span,
            self.voxels,
            self.adapter,
            self.driver,
            self.date,
            self.voxelize_ms,
            wall.median_ms,
            wall.p5_ms,
            wall.p95_ms,
        )
    }
}
