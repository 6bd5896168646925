//! `octolume accuracy`: holes and spill of moved voxels against the exact posed voxelization,
//! beside what each filter costs.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use octolume::accuracy::{self, Row};
use octolume::export;
use octolume::settings::{Filter, MotionSettings, Settings, View};

use super::options::Common;
use super::session::{NO_PICTURE, Session};
use super::{Usage, output, values};

/// Size of the ghost pictures.
const SIZE_PX: [u32; 2] = [960, 540];

/// Compares moved voxels, nearest and split, with the posed mesh voxelized exactly
#[derive(Debug, Args)]
pub struct Accuracy {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// Prints JSON
    #[arg(long)]
    json: bool,
    /// A folder to write the table (.csv and .md) and a ghost picture a row into
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Moments to compare, seconds; otherwise at 1/4, 1/2 and 3/4 of the clip
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', value_parser = values::number)]
    times: Vec<f64>,
    /// Turns of the whole scene about its vertical axis, degrees; otherwise 0, 10 and 37 if no clip is played
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', value_parser = values::number, allow_hyphen_values = true)]
    turns: Vec<f64>,
    /// Grids to compare on; otherwise that of the settings
    #[arg(long, value_name = "N,M,…", value_delimiter = ',')]
    grids: Vec<u32>,
    #[command(flatten)]
    common: Common,
}

impl Accuracy {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        settings.look.accuracy = true;
        let grids = if self.grids.is_empty() { vec![settings.discretization.grid] } else { self.grids.clone() };
        self.check(&settings, &grids)?;
        if let Some(folder) = &self.output {
            std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        settings.discretization.grid = grids[0];
        let mut session = Session::open(&self.scene, &self.common, &settings)?;
        let poses = self.poses(&session, &settings)?;
        let mut rows = Vec::new();
        for grid in grids {
            settings.discretization.grid = grid;
            session.voxelize_again(&settings)?;
            for (number, pose) in poses.iter().enumerate() {
                settings.motion = pose.clone();
                rows.extend(self.compare(&mut session, &mut settings, number)?);
            }
        }
        if let Some(folder) = &self.output {
            write_tables(folder, &rows)?;
        }
        if self.json { output::json(&rows) } else { output::result(&table(&rows)) }
    }
}

impl Accuracy {
    /// Every combination that will be run.
    fn check(&self, settings: &Settings, grids: &[u32]) -> Result<(), Usage> {
        let mut trial = settings.clone();
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

    fn poses(&self, session: &Session, settings: &Settings) -> anyhow::Result<Vec<MotionSettings>> {
        let motion = &settings.motion;
        Ok(match (self.times.is_empty(), self.turns.is_empty()) {
            (true, true) => accuracy::default_poses(&session.prepared, motion)?,
            (true, false) => accuracy::turned(motion, &self.turns),
            (false, true) => accuracy::at_times(motion, &self.times),
            (false, false) => accuracy::at_times(motion, &self.times)
                .iter()
                .flat_map(|moment| accuracy::turned(moment, &self.turns))
                .collect(),
        })
    }

    /// A row a filter, and its ghost picture if wanted.
    fn compare(&self, session: &mut Session, settings: &mut Settings, pose: usize) -> anyhow::Result<Vec<Row>> {
        session.take_exact(settings)?;
        settings.look.view = View::Voxels;
        session.run(settings, NO_PICTURE)?;
        let report = session.engine.accuracy().context("the scene has no voxels to compare")?;
        let exact = report.exact_cells.context("the posed mesh was not compared")?;
        let clip = session.prepared.clip_index(&settings.motion)?;
        let row = |measured| Row {
            scene: session.prepared.scene.name.clone(),
            clip: clip.map(|clip| session.prepared.scene.clips[clip].name.clone()).unwrap_or_default(),
            time_secs: settings.motion.time_secs,
            turn_degrees: settings.motion.turn_degrees,
            grid: settings.discretization.grid,
            span: session.prepared.grid.span,
            exact,
            measured,
        };
        let rows: Vec<Row> = [report.nearest, report.split].into_iter().flatten().map(row).collect();
        if let Some(folder) = &self.output {
            for row in &rows {
                let name = output::name_of(&row.measured.filter);
                draw_ghost(session, settings, row.measured.filter, &folder.join(format!("ghost-{}-{pose}-{name}.png", row.grid)))?;
            }
        }
        Ok(rows)
    }
}

fn draw_ghost(session: &mut Session, settings: &Settings, filter: Filter, file: &Path) -> anyhow::Result<()> {
    let mut settings = settings.clone();
    settings.look.view = View::Ghost;
    settings.look.accuracy = false;
    settings.discretization.filter = filter;
    session.run(&settings, SIZE_PX)?;
    Ok(export::write_png(file, &session.engine.read_image()?, &settings)?)
}

fn write_tables(folder: &Path, rows: &[Row]) -> anyhow::Result<()> {
    let markdown = folder.join("accuracy.md");
    std::fs::write(&markdown, table(rows) + "\n").with_context(|| markdown.display().to_string())?;
    let file = folder.join("accuracy.csv");
    let written = csv::Writer::from_path(&file).map_err(anyhow::Error::from).and_then(|mut csv| {
        csv.write_record(HEADS)?;
        rows.iter().try_for_each(|row| csv.write_record(cells(row)))?;
        Ok(csv.flush()?)
    });
    written.with_context(|| file.display().to_string())
}

const HEADS: [&str; 12] = [
    "scene", "clip", "time s", "turn °", "grid", "filter", "kernel ms", "exact cells", "leaves", "MB", "holes %", "spill %",
];

fn table(rows: &[Row]) -> String {
    output::table(&HEADS, rows.iter().map(cells))
}

fn cells(row: &Row) -> Vec<String> {
    let [x, y, z] = row.turn_degrees;
    vec![
        row.scene.clone(),
        row.clip.clone(),
        format!("{:.3}", row.time_secs),
        format!("{x} {y} {z}"),
        row.grid.to_string(),
        output::name_of(&row.measured.filter),
        format!("{:.2}", row.measured.kernel_ms),
        row.exact.to_string(),
        row.measured.leaves.to_string(),
        format!("{:.1}", row.measured.bytes as f64 / 1e6),
        percent(row.holes_percent()),
        percent(row.spill_percent()),
    ]
}

fn percent(share: Option<f64>) -> String {
    share.map(|percent| format!("{percent:.3}")).unwrap_or_default()
}
