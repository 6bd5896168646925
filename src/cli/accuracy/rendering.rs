//! Light that cones bring against the path tracer, term by term: errors, times and pictures.
//!
//! Every term is compared at the pixels' centres. Without bounces in the octree, the truth is the path
//! tracer's first bounce; with any, all of them.

use std::path::Path;

use anyhow::Context;
use clap::Args;
use image::DynamicImage;
use octolume::accuracy::path_tracer::{Film, Options, Term};
use octolume::accuracy::picture_error::{self, LightPixel, PictureError, Shown, difference_map, difference_scale};
use octolume::export;
use octolume::settings::{Settings, SurfaceView, View};
use serde::Serialize;

use super::race::{Race, flip};
use super::{Case, Table};
use crate::cli::reference::traced;
use crate::cli::session::Session;
use crate::cli::surface_times;
use crate::cli::{output, values::Size};

const SIZE_PX: [u32; 2] = [320, 180];
const SAMPLES: u32 = 256;
/// A term, and how the kernels that make it begin.
type TermKernels = (SurfaceView, &'static [&'static str]);

/// What is shown, and the terms that are read from that frame.
const FRAMES: [(SurfaceView, &[TermKernels]); 2] = [
    (
        SurfaceView::Final,
        &[
            (SurfaceView::Direct, &["surface/emission", "surface/direct"]),
            (SurfaceView::Diffuse, &["cones/diffuse", "cones/blur", "cones/upsample"]),
            (SurfaceView::Specular, &["cones/glossy", "cones/list", "cones/specular"]),
            (SurfaceView::Final, &["surface/", "cones/"]),
        ],
    ),
    // Beside light, cones need not tell what is near.
    (SurfaceView::Ao, &[(SurfaceView::Ao, &["cones/diffuse", "cones/blur", "cones/upsample"])]),
];

#[derive(Debug, Args)]
pub struct RenderingOptions {
    /// Compares surfaces lit by cones with the path tracer instead, term by term
    #[arg(long, conflicts_with = "lighting")]
    pub rendering: bool,
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

/// One term of one pose.
#[derive(Serialize)]
pub struct Row {
    scene: String,
    time_secs: f64,
    turn_degrees: [f64; 3],
    grid: u32,
    span: f64,
    size_px: [u32; 2],
    bounces: u32,
    term: SurfaceView,
    #[serde(flatten)]
    error: PictureError,
    /// Of the kernels behind the term, medians.
    cones_ms: f64,
    /// Of all terms of the truth.
    paths_secs: f64,
    samples: u32,
    /// Standard error of the truth over its mean: of pixels, root mean square, and of the whole picture.
    paths_error: f64,
    paths_mean_error: f64,
    /// Of the final picture.
    #[serde(flatten)]
    race: Option<Race>,
}

/// What cones bring, and what paths do.
struct Compared<'a> {
    part: SurfaceView,
    cones: &'a [LightPixel],
    truth: &'a [LightPixel],
    shown: Shown,
}

impl RenderingOptions {
    /// A row a term. Pictures of cones, paths and their difference where there is a folder for them.
    pub fn compare(&self, session: &mut Session, settings: &Settings, case: &Case) -> anyhow::Result<Vec<Row>> {
        let size_px = self.size.map_or(SIZE_PX, |Size(size_px)| size_px);
        let mut settings = settings.clone();
        (settings.look.view, settings.look.surface) = (View::Surfaces, SurfaceView::Final);
        let options = Options { seed: self.seed.unwrap_or(0), ..Options::new(size_px) };
        let samples = self.samples.unwrap_or(SAMPLES);
        let film = traced((&session.prepared, session.disk()), &settings, options, samples)?;
        let mut rows = Vec::new();
        for (surface, terms) in FRAMES {
            settings.look.surface = surface;
            // After a run that is not measured.
            let measured = surface_times::measure(session, &settings, size_px, (1, case.runs))?;
            let kernels_ms = surface_times::medians(&measured);
            for (part, kernels) in terms {
                let cones_ms = surface_times::sum(&kernels_ms, kernels);
                let Some(cones) = session.engine.read_surface_part(*part)? else { continue };
                let truth = film.shown(*part, &settings.lighting).context("paths show every term")?;
                let shown = Shown::new(&settings.look, *part, &truth);
                let term = Compared { part: *part, cones: &cones, truth: &truth, shown };
                if let Some(folder) = case.folder {
                    term.draw(&settings, size_px, &folder.join(stem(session, &settings, case.number)))?;
                }
                rows.push(term.row(session, &settings, &film, cones_ms)?);
            }
        }
        settings.look.surface = SurfaceView::Final;
        for row in rows.iter_mut().filter(|row| row.term == SurfaceView::Final) {
            let cones = (row.cones_ms / 1e3, row.error);
            row.race = Some(Race::run(session, &settings, (&film, options), cones)?);
        }
        Ok(rows)
    }
}

fn stem(session: &Session, settings: &Settings, number: usize) -> String {
    format!("{}-{}-{number}", session.prepared.scene.name, settings.discretization.grid)
}

impl Compared<'_> {
    fn error(&self, size_px: [u32; 2]) -> anyhow::Result<PictureError> {
        Ok(picture_error::compare(self.cones, self.truth, size_px, &self.shown)?)
    }

    /// `STEM-diffuse-cones.png`, `-paths.png` and `-difference.png`.
    fn draw(&self, settings: &Settings, size_px: [u32; 2], stem: &Path) -> anyhow::Result<()> {
        let mut settings = settings.clone();
        settings.look.surface = self.part;
        let shown = |light: &[LightPixel]| DynamicImage::from(self.shown.picture(light, size_px)).into_rgba8();
        let difference = difference_map(self.cones, self.truth, size_px, difference_scale(self.truth));
        let pictures = [("cones", shown(self.cones)), ("paths", shown(self.truth)), ("difference", difference)];
        for (name, picture) in pictures {
            let mut file = stem.as_os_str().to_owned();
            file.push(format!("-{}-{name}.png", output::name_of(&self.part)));
            export::write_png(Path::new(&file), &picture, &settings)?;
        }
        Ok(())
    }

    fn row(&self, session: &Session, settings: &Settings, film: &Film, cones_ms: f64) -> anyhow::Result<Row> {
        let bounces = settings.lighting.bounces;
        let stated = Term::of(self.part, bounces).map(|term| film.standard_error(term)).unwrap_or_default();
        Ok(Row {
            scene: session.prepared.scene.name.clone(),
            time_secs: settings.motion.time_secs,
            turn_degrees: settings.motion.turn_degrees,
            grid: settings.discretization.grid,
            span: session.prepared.grid.span,
            size_px: film.size_px(),
            bounces,
            term: self.part,
            error: self.error(film.size_px())?,
            cones_ms,
            paths_secs: film.secs(),
            samples: film.samples(),
            paths_error: stated.relative,
            paths_mean_error: stated.relative_of_mean,
            race: None,
        })
    }
}

const HEADS: [&str; 13] = [
    "scene",
    "time s",
    "turn °",
    "grid",
    "bounces",
    "term",
    "relMSE",
    "bias %",
    "SSIM",
    "FLIP",
    "cones ms",
    "paths s",
    "paths ± %",
];

pub fn table(rows: &[Row]) -> Table<'static> {
    Table { stem: "rendering", heads: &HEADS, rows: rows.iter().map(cells).collect() }
}

fn cells(row: &Row) -> Vec<String> {
    let PictureError { rel_mse, bias, ssim, flip } = row.error;
    vec![
        row.scene.clone(),
        format!("{:.3}", row.time_secs),
        super::turn(row.turn_degrees),
        row.grid.to_string(),
        row.bounces.to_string(),
        output::name_of(&row.term),
        format!("{rel_mse:.4}"),
        format!("{:+.2}", 100.0 * bias),
        format!("{ssim:.4}"),
        flip.map(|flip| format!("{flip:.4}")).unwrap_or_default(),
        format!("{:.1}", row.cones_ms),
        format!("{:.1}", row.paths_secs),
        format!("{:.2}", 100.0 * row.paths_error),
    ]
}

/// What the table has no room for: paths in the time of cones.
pub fn sentences(rows: &[Row]) -> Vec<String> {
    let of_row = |row: &Row| {
        let (scene, secs) = (&row.scene, row.cones_ms / 1e3);
        Some(format!("{scene}: cones {secs:.2} s, {}; {}", flip(&row.error), row.race.as_ref()?.text()))
    };
    rows.iter().filter_map(of_row).collect()
}
