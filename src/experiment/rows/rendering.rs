//! What is told of cones beside paths: a row a term.

use serde::Serialize;

use super::race::{Race, flip};
use crate::accuracy::picture_error::PictureError;
use crate::experiment::table::{Table, name_of, turn};
use crate::settings::SurfaceView;

/// One term of one pose.
#[derive(Clone, Debug, Serialize)]
pub struct RenderingRow {
    pub scene: String,
    pub time_secs: f64,
    pub turn_degrees: [f64; 3],
    pub grid: u32,
    pub span: f64,
    pub size_px: [u32; 2],
    pub bounces: u32,
    pub term: SurfaceView,
    #[serde(flatten)]
    pub error: PictureError,
    /// Of the kernels behind the term, medians.
    pub cones_ms: f64,
    /// Of all terms of the truth.
    pub paths_secs: f64,
    pub samples: u32,
    /// Standard error of the truth over its mean: of pixels, root mean square, and of the whole picture.
    pub paths_error: f64,
    pub paths_mean_error: f64,
    /// Of the final picture.
    #[serde(flatten)]
    pub(in crate::experiment) race: Option<Race>,
}

impl RenderingRow {
    const HEADS: [&'static str; 13] = [
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

    pub(in crate::experiment) fn table(rows: &[Self]) -> Table {
        Table::new("rendering", &Self::HEADS, rows.iter().map(Self::cells))
    }

    fn cells(&self) -> Vec<String> {
        let PictureError { rel_mse, bias, ssim, flip } = self.error;
        vec![
            self.scene.clone(),
            format!("{:.3}", self.time_secs),
            turn(self.turn_degrees),
            self.grid.to_string(),
            self.bounces.to_string(),
            name_of(&self.term),
            format!("{rel_mse:.4}"),
            format!("{:+.2}", 100.0 * bias),
            format!("{ssim:.4}"),
            flip.map(|flip| format!("{flip:.4}")).unwrap_or_default(),
            format!("{:.1}", self.cones_ms),
            format!("{:.1}", self.paths_secs),
            format!("{:.2}", 100.0 * self.paths_error),
        ]
    }
}

/// What the table has no room for: paths in the time of cones.
pub fn paths_in_that_time(rows: &[RenderingRow]) -> Vec<String> {
    let of_row = |row: &RenderingRow| {
        let (scene, secs) = (&row.scene, row.cones_ms / 1e3);
        Some(format!("{scene}: cones {secs:.2} s, {}; {}", flip(&row.error), row.race.as_ref()?.text()))
    };
    rows.iter().filter_map(of_row).collect()
}
