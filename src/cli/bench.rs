//! `octolume bench`: what each kernel costs, beside what its memory traffic alone would cost.

use std::path::PathBuf;

use clap::Args;
use octolume::experiment::{self, BenchOptions, Found, KernelReport, Report, Table};

use super::drive::drive;
use super::options::{Common, Moment};
use super::output;
use super::session::Session;
use super::usage::Usage;

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
    /// Compares the discretizers instead: moving voxels, and voxelizing the posed triangles, in turns
    #[arg(long, conflicts_with_all = ["lighting", "surfaces"])]
    discretizers: bool,
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

impl Bench {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        settings.check().map_err(Usage)?;
        // Voxelization is measured too, so its results are not looked for on the disk.
        let session = Session::open_with(&self.scene, &self.common, None, &mut settings)?;
        let (warmup, light, surfaces) = (self.warmup, self.lighting, self.surfaces);
        let options = BenchOptions { warmup, rebuild: true, light, surfaces };
        let subject = session.subject(&settings, self.runs);
        let gpu = session.engine.gpu();
        let experiment = match self.discretizers {
            true => experiment::discretizers(gpu, subject, warmup),
            false => experiment::bench(gpu, subject, options),
        };
        let report = drive(experiment, None)?;
        if self.json { output::json(&report) } else { output::result(&text(&report)) }
    }
}

fn text(report: &Report) -> String {
    let tables = report.tables();
    match &report.found {
        Found::Kernels(kernels) => {
            let texts: Vec<String> = tables.iter().map(|table| table_text(table, kernels)).collect();
            let (first, more) = texts.split_first().map_or(("", &[][..]), |(first, more)| (first.as_str(), more));
            let more: String = more.iter().map(|text| format!("\n\n{text}")).collect();
            format!("{}\n\n{first}\n\n{}{more}", head(report, kernels), once(kernels))
        }
        _ => tables.iter().map(output::rows).collect(),
    }
}

fn head(report: &Report, kernels: &KernelReport) -> String {
    format!(
        "{} at {} cells of {} units, {} voxels, on {} ({}), {}",
        kernels.scene,
        report.settings.method.discretization.grid,
        kernels.span,
        kernels.voxels,
        report.adapter,
        report.driver,
        report.date,
    )
}

/// What is not of any kernel.
fn once(kernels: &KernelReport) -> String {
    let wall = kernels.frame_wall.unwrap_or_default();
    format!(
        "voxelized once in {:.0} ms; a frame by the clock: {:.1} ms ({:.1} to {:.1})",
        kernels.voxelize_ms, wall.median_ms, wall.p5_ms, wall.p95_ms,
    )
}

/// A table, and what belongs to it beside its rows.
fn table_text(table: &Table, kernels: &KernelReport) -> String {
    let text = output::rows(table);
    let memory = kernels.light.as_ref().and_then(|light| light.memory);
    match (table.stem, memory, &kernels.surfaces) {
        ("sampling", Some(m), _) => format!(
            "{text}\n\n{} nodes: {} bytes of octree, {} of light, {} of pointers a block ({} a node); \
             {:.1} bytes a node ({:.1} with pointers a node)",
            m.nodes,
            m.octree_bytes,
            m.light_bytes,
            m.block_pointer_bytes,
            m.node_pointer_bytes,
            m.bytes_per_node,
            m.bytes_per_node_with_node_pointers,
        ),
        ("surfaces", _, Some(surfaces)) => {
            let [width, height] = surfaces.size_px;
            format!("lit surfaces, {width} x {height} pixels\n\n{text}")
        }
        _ => text,
    }
}
