//! Tables of `octolume accuracy`: voxels, and shadows.

use serde::Deserialize;

use super::markdown::{Table, three_digits};
use super::measured::Files;

#[derive(Deserialize)]
struct VoxelRow {
    scene: String,
    clip: Option<String>,
    time_secs: f64,
    turn_degrees: [f64; 3],
    grid: u32,
    /// Cells of the posed mesh.
    exact: u64,
    nearest: FilterCost,
    split: FilterCost,
}

#[derive(Deserialize)]
struct FilterCost {
    kernel_ms: f64,
    leaves: u64,
    holes: u64,
    spill: u64,
}

impl FilterCost {
    fn cells(&self, exact: u64) -> [String; 3] {
        let percent = |part: u64, whole: u64| format!("{:.3}", 100.0 * part as f64 / whole as f64);
        [three_digits(self.kernel_ms), percent(self.holes, exact), percent(self.spill, self.leaves)]
    }
}

pub fn voxels(files: &Files) -> Table {
    let heads = ["scene", "clip", "time s", "turn °", "grid", "exact cells"];
    let costs = ["nearest ms", "holes %", "spill %", "split ms", "holes %", "spill %"];
    let mut table = Table::new(2, heads.into_iter().chain(costs));
    for row in files.rows::<VoxelRow>() {
        let place = [
            row.scene,
            row.clip.unwrap_or_default(),
            format!("{:.3}", row.time_secs),
            row.turn_degrees[1].to_string(),
            row.grid.to_string(),
            row.exact.to_string(),
        ];
        let costs = [row.nearest.cells(row.exact), row.split.cells(row.exact)];
        table.row(place.into_iter().chain(costs.into_iter().flatten()));
    }
    table
}

#[derive(Deserialize)]
struct ShadowRow {
    scene: String,
    turn_degrees: [f64; 3],
    grid: u32,
    light: String,
    shadows: String,
    map_px: Option<u32>,
    kernel_ms: f64,
    lit_percent: f64,
    mean_error_percent: f64,
    lost_percent: f64,
    leaked_percent: f64,
}

pub fn shadows(files: &Files) -> Table {
    let heads = ["scene", "light", "shadows", "turn °", "grid", "ms", "lit %", "mean error %", "lost %", "leaked %"];
    let mut table = Table::new(3, heads);
    for row in files.rows::<ShadowRow>() {
        let percents = [row.lit_percent, row.mean_error_percent, row.lost_percent, row.leaked_percent];
        let place = [
            row.scene,
            row.light,
            row.map_px.map_or(row.shadows.clone(), |px| format!("{} {px}", row.shadows)),
            row.turn_degrees[1].to_string(),
            row.grid.to_string(),
            three_digits(row.kernel_ms),
        ];
        table.row(place.into_iter().chain(percents.map(|percent| format!("{percent:.2}"))));
    }
    table
}
