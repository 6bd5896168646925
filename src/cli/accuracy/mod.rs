//! `octolume accuracy`: what moved voxels get wrong beside what they cost. Holes and spill against the
//! exact posed voxelization, or shadows against rays through the posed triangles, or lit surfaces against
//! the path tracer.

mod race;
mod rendering;
mod shadows;
mod voxels;

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use octolume::accuracy;
use octolume::settings::{ColorBy, MotionSettings, Settings, View};

use rendering::RenderingOptions;

use super::options::Common;
use super::session::Session;
use super::{Usage, output, values};

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
    /// A folder to write the table into, .csv and .md, and two ghost pictures a row of voxels, or three a term of
    /// light: of cones, of paths, and where cones are too bright (red) or too dark (blue) by up to the mean
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

/// Rows of text, and what their files are called.
struct Table<'a> {
    stem: &'a str,
    heads: &'a [&'a str],
    rows: Vec<Vec<String>>,
}

/// One pose of one scene on one grid: where pictures of it go, and how often it is measured.
struct Case<'a> {
    folder: Option<&'a Path>,
    number: usize,
    runs: u32,
}

impl Accuracy {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        settings.look.view = View::Voxels;
        if self.lighting {
            settings.look.color = ColorBy::Radiance;
        } else if !self.rendering.rendering {
            settings.look.accuracy = true;
        }
        let grids = if self.grids.is_empty() { vec![settings.discretization.grid] } else { self.grids.clone() };
        self.check(&settings, &grids)?;
        if let Some(folder) = &self.output {
            std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        if self.rendering.rendering {
            let compare = |session: &mut Session, settings: &Settings, case: &Case| {
                self.rendering.compare(session, settings, case)
            };
            let rows = self.compare_scenes(&settings, &grids, compare)?;
            rendering::sentences(&rows).iter().for_each(|sentence| output::message(sentence));
            self.write(&rows, &rendering::table(&rows))
        } else if self.lighting {
            let rows = self.compare_scenes(&settings, &grids, shadows::compare)?;
            self.write(&rows, &shadows::table(&rows))
        } else {
            let rows = self.compare_scenes(&settings, &grids, voxels::compare)?;
            self.write(&rows, &voxels::table(&rows))
        }
    }

    /// Every value that will be used.
    fn check(&self, settings: &Settings, grids: &[u32]) -> Result<(), Usage> {
        let mut trial = settings.clone();
        trial.check().map_err(Usage)?;
        for &grid in grids {
            trial.discretization.grid = grid;
            trial.check().map_err(Usage)?;
        }
        for &time_secs in &self.times {
            trial.motion.time_secs = time_secs;
            trial.check().map_err(Usage)?;
        }
        Ok(())
    }

    fn compare_scenes<R>(
        &self,
        settings: &Settings,
        grids: &[u32],
        compare: impl Fn(&mut Session, &Settings, &Case) -> anyhow::Result<Vec<R>>,
    ) -> anyhow::Result<Vec<R>> {
        let mut rows = Vec::new();
        for scene in &self.scenes {
            let mut settings = settings.clone();
            settings.discretization.grid = grids[0];
            let mut session = Session::open(scene, &self.common, &mut settings)?;
            let poses = self.poses(&session, &settings.motion)?;
            for &grid in grids {
                settings.discretization.grid = grid;
                session.voxelize_again(&settings)?;
                for (number, pose) in poses.iter().enumerate() {
                    settings.motion = pose.clone();
                    let case = Case { folder: self.output.as_deref(), number, runs: self.runs };
                    rows.extend(compare(&mut session, &settings, &case)?);
                }
            }
        }
        Ok(rows)
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

    fn write(&self, rows: &[impl serde::Serialize], table: &Table) -> anyhow::Result<()> {
        let text = output::table(table.heads, table.rows.iter().cloned());
        if let Some(folder) = &self.output {
            let markdown = folder.join(format!("{}.md", table.stem));
            std::fs::write(&markdown, format!("{text}\n")).with_context(|| markdown.display().to_string())?;
            let file = folder.join(format!("{}.csv", table.stem));
            table.write_csv(&file).with_context(|| file.display().to_string())?;
        }
        if self.json { output::json(&rows) } else { output::result(&text) }
    }
}

impl Table<'_> {
    fn write_csv(&self, file: &Path) -> anyhow::Result<()> {
        let mut csv = csv::Writer::from_path(file)?;
        csv.write_record(self.heads)?;
        self.rows.iter().try_for_each(|row| csv.write_record(row))?;
        Ok(csv.flush()?)
    }
}

/// As angles about x, y and z in tables.
fn turn([x, y, z]: [f64; 3]) -> String {
    format!("{x} {y} {z}")
}
