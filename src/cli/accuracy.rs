//! `octolume accuracy`: what moved voxels get wrong beside what they cost. Holes and spill against the
//! exact posed voxelization, or shadows against rays through the posed triangles, or lit surfaces against
//! the path tracer.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use octolume::accuracy;
use octolume::experiment::{self, Experiment, Found, Report, Table};
use octolume::settings::{MotionSettings, Settings};

use super::drive::drive;
use super::options::Common;
use super::output;
use super::session::Session;
use super::usage::Usage;
use super::values::{self, Size};

/// Compares moved voxels, nearest and split, with the posed mesh voxelized exactly
#[derive(Debug, Args)]
pub struct Accuracy {
    /// .gltf or .glb files, or names of built-in scenes
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Compares shadows with rays through the posed triangles instead: by shadow maps of three sizes, by marching,
    /// and none
    #[arg(long)]
    lighting: bool,
    #[command(flatten)]
    rendering: RenderingOptions,
    /// Prints JSON
    #[arg(long)]
    json: bool,
    /// A folder to write the table into, .csv, .md and .json, and two ghost pictures a row of voxels, or three a term
    /// of light: of cones, of paths, and where cones are too bright (red) or too dark (blue) by up to the mean
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Moments to compare, seconds; otherwise at 1/4, 1/2 and 3/4 of the clip, and for --lighting and --rendering its start
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', value_parser = values::number, allow_hyphen_values = true)]
    times: Vec<f64>,
    /// Turns of the whole scene about its vertical axis, degrees; otherwise 0, 10 and 37 if no clip is played, and
    /// for --lighting and --rendering none
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', value_parser = values::number, allow_hyphen_values = true)]
    turns: Vec<f64>,
    /// Grids to compare on; otherwise that of the settings
    #[arg(long, value_name = "N,M,…", value_delimiter = ',')]
    grids: Vec<u32>,
    /// Rebuilds measured a pose, after one that is not; milliseconds are their medians
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    runs: u32,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Args)]
struct RenderingOptions {
    /// Compares surfaces lit by cones with the path tracer instead, term by term
    #[arg(long, conflicts_with = "lighting")]
    rendering: bool,
    /// Pixels of the pictures that --rendering compares; otherwise 320x180
    #[arg(long, value_name = "WxH", requires = "rendering")]
    size: Option<Size>,
    /// Paths a pixel and lobe of the truth; otherwise 256
    #[arg(long, value_name = "N", requires = "rendering", value_parser = clap::value_parser!(u32).range(2..))]
    samples: Option<u32>,
    /// Another number, other noise in the truth; otherwise 0
    #[arg(long, value_name = "N", requires = "rendering")]
    seed: Option<u64>,
}

impl Accuracy {
    pub fn run(&self) -> anyhow::Result<()> {
        let settings = self.common.settings()?;
        let grids = if self.grids.is_empty() { vec![settings.method.discretization.grid] } else { self.grids.clone() };
        self.check(&settings, &grids)?;
        if let Some(folder) = &self.output {
            std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        let report = self.compare_scenes(&settings, &grids)?;
        if let Found::Rendering { rows } = &report.found {
            experiment::paths_in_that_time(rows).iter().for_each(|sentence| output::message(sentence));
        }
        self.write(&report)
    }

    /// Every value that will be used.
    fn check(&self, settings: &Settings, grids: &[u32]) -> Result<(), Usage> {
        let mut trial = settings.clone();
        trial.check().map_err(Usage)?;
        for &grid in grids {
            trial.method.discretization.grid = grid;
            trial.check().map_err(Usage)?;
        }
        for &time_secs in &self.times {
            trial.shot.motion.time_secs = time_secs;
            trial.check().map_err(Usage)?;
        }
        Ok(())
    }

    /// An experiment a scene and grid, their rows in one report.
    fn compare_scenes(&self, settings: &Settings, grids: &[u32]) -> anyhow::Result<Report> {
        let mut report: Option<Report> = None;
        for scene in &self.scenes {
            let mut settings = settings.clone();
            settings.method.discretization.grid = grids[0];
            let mut session = Session::open(scene, &self.common, &mut settings)?;
            let poses = self.poses(&session, &settings.shot.motion)?;
            for &grid in grids {
                settings.method.discretization.grid = grid;
                session.voxelize_again(&settings)?;
                let found = drive(self.experiment(&session, &settings, poses.clone()), self.output.as_deref())?;
                match &mut report {
                    Some(report) => report.append(found),
                    None => report = Some(found),
                }
            }
        }
        report.context("there is no scene to compare")
    }

    fn experiment(&self, session: &Session, settings: &Settings, poses: Vec<MotionSettings>) -> Experiment {
        let (gpu, draws) = (session.engine.gpu(), self.output.is_some());
        let subject = session.subject(settings, self.runs);
        if self.rendering.rendering {
            experiment::rendering(gpu, subject, poses, self.rendering.options(session, draws))
        } else if self.lighting {
            experiment::shadows(gpu, subject, poses)
        } else {
            experiment::voxels(gpu, subject, poses, draws)
        }
    }

    fn poses(&self, session: &Session, motion: &MotionSettings) -> anyhow::Result<Vec<MotionSettings>> {
        Ok(match (self.times.is_empty(), self.turns.is_empty()) {
            (true, true) if self.lighting || self.rendering.rendering => vec![motion.clone()],
            (true, true) => accuracy::default_poses(&session.prepared, motion)?,
            (true, false) => accuracy::turned(motion, &self.turns),
            (false, true) => accuracy::at_times(motion, &self.times),
            (false, false) => accuracy::at_times(motion, &self.times)
                .iter()
                .flat_map(|moment| accuracy::turned(moment, &self.turns))
                .collect(),
        })
    }

    fn write(&self, report: &Report) -> anyhow::Result<()> {
        let tables = report.tables();
        for (folder, table) in self.output.iter().flat_map(|folder| tables.iter().map(move |table| (folder, table))) {
            let file = |extension: &str| folder.join(format!("{}.{extension}", table.stem));
            write_text(&file("md"), &output::rows(table))?;
            write_text(&file("json"), &serde_json::to_string_pretty(report).context("JSON")?)?;
            write_csv(table, &file("csv")).with_context(|| file("csv").display().to_string())?;
        }
        if self.json {
            return output::json(report);
        }
        tables.iter().try_for_each(|table| output::result(&output::rows(table)))
    }
}

impl RenderingOptions {
    fn options(&self, session: &Session, draws: bool) -> experiment::RenderingOptions {
        let usual = experiment::RenderingOptions::default();
        experiment::RenderingOptions {
            size_px: self.size.map_or(usual.size_px, |Size(size_px)| size_px),
            samples: self.samples.unwrap_or(usual.samples),
            seed: self.seed.unwrap_or(usual.seed),
            disk: session.disk().cloned(),
            draws,
        }
    }
}

fn write_text(file: &Path, text: &str) -> anyhow::Result<()> {
    std::fs::write(file, format!("{text}\n")).with_context(|| file.display().to_string())
}

fn write_csv(table: &Table, file: &Path) -> anyhow::Result<()> {
    let mut csv = csv::Writer::from_path(file)?;
    csv.write_record(&table.heads)?;
    table.rows.iter().try_for_each(|row| csv.write_record(row))?;
    Ok(csv.flush()?)
}
