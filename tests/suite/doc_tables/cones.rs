//! Tables of `octolume accuracy --rendering`: cones beside paths, part by part, and against time.

use serde::Deserialize;

use super::markdown::{Table, or_dash, three_digits};
use super::measured::Files;

#[derive(Deserialize)]
struct Row {
    scene: String,
    grid: u32,
    size_px: [u32; 2],
    term: String,
    cones_ms: f64,
    samples: u32,
    /// Standard error of the truth's pixels over its mean.
    paths_error: f64,
    #[serde(flatten)]
    error: PictureError,
    equal_time: Option<Paths>,
    as_right: Option<Paths>,
}

#[derive(Deserialize)]
struct PictureError {
    rel_mse: f64,
    bias: f64,
    ssim: f64,
    flip: Option<f64>,
}

#[derive(Deserialize)]
struct Paths {
    samples: u32,
    secs: f64,
    flip: Option<f64>,
}

impl Row {
    fn title(&self) -> String {
        format!("{}, {}³", self.scene, self.grid)
    }
}

impl Paths {
    fn text(&self) -> String {
        let plural = if self.samples == 1 { "" } else { "s" };
        format!("{} sample{plural}, {} s", self.samples, three_digits(self.secs))
    }
}

fn flip(flip: Option<f64>) -> String {
    or_dash(flip, |flip| format!("{flip:.3}"))
}

/// Errors of every part of light.
pub fn parts(files: &Files) -> Table {
    let heads = ["scene, grid", "part", "cones ms", "bias %", "relMSE", "SSIM", "FLIP", "paths a pixel", "paths ± %"];
    let mut table = Table::new(2, heads);
    for row in files.rows::<Row>() {
        table.row([
            row.title(),
            row.term.clone(),
            three_digits(row.cones_ms),
            format!("{:+.1}", 100.0 * row.error.bias),
            format!("{:.3}", row.error.rel_mse),
            format!("{:.3}", row.error.ssim),
            flip(row.error.flip),
            row.samples.to_string(),
            format!("{:.1}", 100.0 * row.paths_error),
        ]);
    }
    table
}

/// Final pictures of cones, and of paths in about that time.
pub fn race(files: &Files) -> Table {
    let heads = ["final picture", "cones s", "FLIP", "paths in about that time", "FLIP", "paths as right from"];
    let mut table = Table::new(1, heads);
    let rows = files.rows::<Row>();
    for row in rows.iter().filter(|row| row.equal_time.is_some()) {
        let [width, height] = row.size_px;
        table.row([
            format!("{}, {width} x {height}", row.title()),
            three_digits(row.cones_ms / 1e3),
            flip(row.error.flip),
            or_dash(row.equal_time.as_ref(), Paths::text),
            flip(row.equal_time.as_ref().and_then(|paths| paths.flip)),
            or_dash(row.as_right.as_ref(), Paths::text),
        ]);
    }
    table
}
