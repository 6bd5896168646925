//! `octolume accuracy`: holes and spill of moved voxels against the exact posed voxelization,
//! beside what each filter costs.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use octolume::accuracy::{self, Row, spill_percent};
use octolume::engine::FilterReport;
use octolume::export;
use octolume::settings::{Filter, MotionSettings, Settings, View};

use super::options::Common;
use super::session::{NO_PICTURE, Session};
use super::statistics::Spread;
use super::{Usage, output, values};

/// Size of the ghost pictures.
const SIZE_PX: [u32; 2] = [960, 540];

/// Compares moved voxels, nearest and split, with the posed mesh voxelized exactly
#[derive(Debug, Args)]
pub struct Accuracy {
    /// .gltf or .glb files, or names of built-in scenes
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Prints JSON
    #[arg(long)]
    json: bool,
    /// A folder to write the table into, .csv and .md, and two ghost pictures a row
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Moments to compare, seconds; otherwise at 1/4, 1/2 and 3/4 of the clip
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', value_parser = values::number, allow_hyphen_values = true)]
    times: Vec<f64>,
    /// Turns of the whole scene about its vertical axis, degrees; otherwise 0, 10 and 37 if no clip is played
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

impl Accuracy {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        settings.look.view = View::Voxels;
        settings.look.accuracy = true;
        let grids = if self.grids.is_empty() { vec![settings.discretization.grid] } else { self.grids.clone() };
        self.check(&settings, &grids)?;
        if let Some(folder) = &self.output {
            std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        let mut rows = Vec::new();
        for scene in &self.scenes {
            rows.extend(self.compare_scene(scene, &settings, &grids)?);
        }
        if let Some(folder) = &self.output {
            write_tables(folder, &rows)?;
        }
        if self.json { output::json(&rows) } else { output::result(&table(&rows)) }
    }

    /// Every value that will be used.
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

    fn compare_scene(&self, scene: &Path, settings: &Settings, grids: &[u32]) -> anyhow::Result<Vec<Row>> {
        let mut settings = settings.clone();
        settings.discretization.grid = grids[0];
        let mut session = Session::open(scene, &self.common, &mut settings)?;
        let poses = self.poses(&session, &settings.motion)?;
        let mut rows = Vec::new();
        for &grid in grids {
            settings.discretization.grid = grid;
            session.voxelize_again(&settings)?;
            for (number, pose) in poses.iter().enumerate() {
                settings.motion = pose.clone();
                let row = compare(&mut session, &settings, self.runs)?;
                if let Some(folder) = &self.output {
                    draw_ghosts(&mut session, &settings, &folder.join(format!("{}-{grid}-{number}", row.scene)))?;
                }
                rows.push(row);
            }
        }
        Ok(rows)
    }

    fn poses(&self, session: &Session, motion: &MotionSettings) -> anyhow::Result<Vec<MotionSettings>> {
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
}

fn compare(session: &mut Session, settings: &Settings, runs: u32) -> anyhow::Result<Row> {
    session.take_exact(settings)?;
    session.run(settings, NO_PICTURE)?;
    let (mut nearest_ms, mut split_ms) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        session.engine.invalidate();
        session.run(settings, NO_PICTURE)?;
        let report = session.engine.accuracy();
        nearest_ms.extend(report.and_then(|report| Some(report.nearest?.kernel_ms)));
        split_ms.extend(report.and_then(|report| Some(report.split?.kernel_ms)));
    }
    let scene = &session.prepared.scene;
    let nothing = || format!("{} has no voxels to compare", scene.name);
    let report = session.engine.accuracy().with_context(nothing)?;
    let with_median = |filter: Option<FilterReport>, times_ms: &[f64]| {
        let kernel_ms = Spread::of(times_ms)?.median_ms;
        filter.map(|filter| FilterReport { kernel_ms, ..filter })
    };
    let clip = session.prepared.clip_index(&settings.motion)?;
    Ok(Row {
        scene: scene.name.clone(),
        clip: clip.map(|clip| scene.clips[clip].name.clone()),
        time_secs: settings.motion.time_secs,
        turn_degrees: settings.motion.turn_degrees,
        grid: settings.discretization.grid,
        span: session.prepared.grid.span,
        exact: report.exact_cells.with_context(nothing)?,
        nearest: with_median(report.nearest, &nearest_ms).with_context(nothing)?,
        split: with_median(report.split, &split_ms).with_context(nothing)?,
    })
}

/// `STEM-nearest.png` and `STEM-split.png`.
fn draw_ghosts(session: &mut Session, settings: &Settings, stem: &Path) -> anyhow::Result<()> {
    let mut settings = settings.clone();
    settings.look.view = View::Ghost;
    settings.look.accuracy = false;
    for filter in [Filter::Nearest, Filter::Split] {
        settings.discretization.filter = filter;
        session.run(&settings, SIZE_PX)?;
        let mut file = stem.as_os_str().to_owned();
        file.push(format!("-{}.png", output::name_of(&filter)));
        export::write_png(Path::new(&file), &session.engine.read_image()?, &settings)?;
    }
    Ok(())
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
    "scene",
    "clip",
    "time s",
    "turn °",
    "grid",
    "exact cells",
    "nearest ms",
    "nearest holes %",
    "nearest spill %",
    "split ms",
    "split holes %",
    "split spill %",
];

fn table(rows: &[Row]) -> String {
    output::table(&HEADS, rows.iter().map(cells))
}

fn cells(row: &Row) -> Vec<String> {
    let [x, y, z] = row.turn_degrees;
    let mut cells = vec![
        row.scene.clone(),
        row.clip.clone().unwrap_or_default(),
        format!("{:.3}", row.time_secs),
        format!("{x} {y} {z}"),
        row.grid.to_string(),
        row.exact.to_string(),
    ];
    let percent = |share: Option<f64>| share.map(|percent| format!("{percent:.3}")).unwrap_or_default();
    let costs = |filter: &FilterReport| {
        [format!("{:.2}", filter.kernel_ms), percent(row.holes_percent(filter)), percent(spill_percent(filter))]
    };
    cells.extend([&row.nearest, &row.split].into_iter().flat_map(costs));
    cells
}
