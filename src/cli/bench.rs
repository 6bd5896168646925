//! `octolume bench`: what each kernel costs, beside what its memory traffic alone would cost.
//!
//! The floor of a kernel is the bytes it must move over the bandwidth of a copy kernel measured in
//! the same run; the ratio says how far above it the kernel is.

use std::path::PathBuf;
use std::time::{Instant, SystemTime};

use anyhow::Context;
use clap::Args;
use octolume::gpu::{Gpu, Job, KernelTiming, Recorder};
use octolume::settings::{Settings, View};
use octolume::stages::bench::copy;
use serde::Serialize;
use wgpu::BufferUsages;

use super::options::{Common, Moment};
use super::session::Session;
use super::statistics::Spread;
use super::{Usage, output};

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
}

#[derive(Serialize)]
struct Cost {
    kernel: String,
    #[serde(flatten)]
    time: Spread,
    /// What the algorithm has to read and write.
    bytes: u64,
    gb_per_s: f64,
    /// The same bytes at the copy kernel's bandwidth.
    floor_ms: f64,
    /// Median over floor; none where nothing need be moved.
    ratio: Option<f64>,
}

/// Times and bytes of one kernel, or of all together, a rebuild each.
#[derive(Default)]
struct Samples {
    ms: Vec<f64>,
    bytes: u64,
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
            Job::new(recorder).run_to_end(gpu)?;
            let ms = gpu.take_timings().iter().map(|timing| timing.ms).sum();
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
    Ok((session.engine.timings(), wall_ms))
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

impl Samples {
    fn add<'a>(&mut self, timings: impl Iterator<Item = &'a KernelTiming>) {
        let (mut ms, mut bytes) = (0.0, 0);
        for timing in timings {
            ms += timing.ms;
            bytes += timing.bytes_moved;
        }
        self.ms.push(ms);
        self.bytes = bytes;
    }

    fn cost(&self, kernel: String, bytes_per_ms: f64) -> Option<Cost> {
        let time = Spread::of(&self.ms)?;
        let floor_ms = self.bytes as f64 / bytes_per_ms;
        let gb_per_s = self.bytes as f64 / time.median_ms / 1e6;
        let ratio = (floor_ms > 0.0).then(|| time.median_ms / floor_ms);
        Some(Cost { kernel, time, bytes: self.bytes, gb_per_s, floor_ms, ratio })
    }
}

impl Report {
    fn text(&self) -> String {
        let heads = ["kernel", "median ms", "p5", "p95", "MB", "GB/s", "floor ms", "ratio"];
        let all = self.kernels.iter().chain([&self.rebuild, &self.copy]);
        let table = output::table(&heads, all.map(Cost::row));
        let wall = &self.frame_wall;
        format!(
            "{} at {} cells of {} units, {} voxels, on {} ({}), {}\n\n{table}\n\n\
             voxelized once in {:.0} ms; a frame by the clock: {:.1} ms ({:.1} to {:.1})",
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

impl Cost {
    fn row(&self) -> Vec<String> {
        let Spread { median_ms, p5_ms, p95_ms } = self.time;
        vec![
            self.kernel.clone(),
            format!("{median_ms:.2}"),
            format!("{p5_ms:.2}"),
            format!("{p95_ms:.2}"),
            format!("{:.1}", self.bytes as f64 / 1e6),
            format!("{:.1}", self.gb_per_s),
            format!("{:.2}", self.floor_ms),
            self.ratio.map_or_else(String::new, |ratio| format!("{ratio:.1}")),
        ]
    }
}
