//! The table of `octolume bench --discretizers`.

use serde::Deserialize;

use super::markdown::{Table, or_dash, three_digits};
use super::measured::Files;

#[derive(Deserialize)]
struct Report {
    scene: String,
    grid: u32,
    triangles: u64,
    /// Cells of the posed mesh.
    exact: u64,
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    discretizer: String,
    cells: Option<String>,
    filter: String,
    /// What moving does with objects that stretch.
    #[serde(default)]
    stretching: Option<String>,
    discretize: Option<Spread>,
    build: Option<Spread>,
    rebuild: Option<Spread>,
    clock: Option<Spread>,
    ratio: Option<f64>,
    found: Option<Found>,
}

#[derive(Deserialize)]
struct Spread {
    median_ms: f64,
    p5_ms: f64,
    p95_ms: f64,
}

#[derive(Deserialize)]
struct Found {
    voxels: u64,
    leaves: u64,
    holes: u64,
    spill: u64,
}

impl Row {
    fn cells(&self, exact: u64) -> Vec<String> {
        let percent = |part: u64, whole: u64| format!("{:.3}", 100.0 * part as f64 / whole as f64);
        let median = |spread: &Option<Spread>| or_dash(spread.as_ref(), |spread| three_digits(spread.median_ms));
        let range = |spread: &Spread| format!("{} to {}", three_digits(spread.p5_ms), three_digits(spread.p95_ms));
        let found = self.found.as_ref();
        let mixed = if self.stretching.as_deref() == Some("voxelize") { ", stretching voxelized" } else { "" };
        vec![
            format!("{}, {}{mixed}", self.discretizer, self.cells.as_ref().unwrap_or(&self.filter)),
            or_dash(found, |found| found.voxels.to_string()),
            median(&self.discretize),
            or_dash(self.discretize.as_ref(), range),
            median(&self.build),
            median(&self.rebuild),
            or_dash(self.ratio, |ratio| format!("{ratio:.2}")),
            median(&self.clock),
            or_dash(found, |found| percent(found.holes, exact)),
            or_dash(found, |found| percent(found.spill, found.leaves)),
        ]
    }
}

pub fn discretizers(files: &Files) -> Table {
    let heads = ["scene", "way", "voxels", "discretize ms", "p5 to p95", "octree ms", "both ms"];
    let mut table = Table::new(2, heads.into_iter().chain(["× transform", "by the clock ms", "holes %", "spill %"]));
    for report in files.reports::<Report>() {
        for (number, row) in report.rows.iter().enumerate() {
            let scene = match number {
                0 => format!("{}, {} triangles, {}³", report.scene, report.triangles, report.grid),
                _ => String::new(),
            };
            table.row([scene].into_iter().chain(row.cells(report.exact)));
        }
    }
    table
}
