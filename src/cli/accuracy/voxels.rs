//! Holes and spill of moved voxels, nearest and split, against the posed mesh voxelized exactly.

use std::path::Path;

use anyhow::Context;
use octolume::accuracy::{Row, spill_percent};
use octolume::engine::FilterReport;
use octolume::export;
use octolume::settings::{Filter, Settings, View};

use super::{Case, Table};
use crate::cli::output;
use crate::cli::session::{NO_PICTURE, Session};
use octolume::spread::Spread;

/// Size of the ghost pictures.
const SIZE_PX: [u32; 2] = [960, 540];

/// Both filters; milliseconds are medians. Two pictures where there is a folder for them.
pub fn compare(session: &mut Session, settings: &Settings, case: &Case) -> anyhow::Result<Vec<Row>> {
    let row = compare_filters(session, settings, case.runs)?;
    if let Some(folder) = case.folder {
        draw_ghosts(session, settings, &folder.join(format!("{}-{}-{}", row.scene, row.grid, case.number)))?;
    }
    Ok(vec![row])
}

fn compare_filters(session: &mut Session, settings: &Settings, runs: u32) -> anyhow::Result<Row> {
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

pub fn table(rows: &[Row]) -> Table<'static> {
    Table { stem: "accuracy", heads: &HEADS, rows: rows.iter().map(cells).collect() }
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

fn cells(row: &Row) -> Vec<String> {
    let mut cells = vec![
        row.scene.clone(),
        row.clip.clone().unwrap_or_default(),
        format!("{:.3}", row.time_secs),
        super::turn(row.turn_degrees),
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
