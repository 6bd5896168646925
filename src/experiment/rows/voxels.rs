//! What is told of moved voxels beside exact ones: a row a pose and grid.

use serde::Serialize;

use crate::accuracy::percent;
use crate::engine::FilterReport;
use crate::experiment::table::{Table, turn};

/// One pose on one grid, both filters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VoxelRow {
    pub scene: String,
    pub clip: Option<String>,
    pub time_secs: f64,
    pub turn_degrees: [f64; 3],
    pub grid: u32,
    pub span: f64,
    /// Cells of the exact posed voxelization.
    pub exact: u64,
    pub nearest: FilterReport,
    pub split: FilterReport,
}

impl VoxelRow {
    const HEADS: [&'static str; 12] = [
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

    pub(in crate::experiment) fn table(rows: &[Self]) -> Table {
        Table::new("accuracy", &Self::HEADS, rows.iter().map(Self::cells))
    }

    fn cells(&self) -> Vec<String> {
        let mut cells = vec![
            self.scene.clone(),
            self.clip.clone().unwrap_or_default(),
            format!("{:.3}", self.time_secs),
            turn(self.turn_degrees),
            self.grid.to_string(),
            self.exact.to_string(),
        ];
        let shown = |share: Option<f64>| share.map(|percent| format!("{percent:.3}")).unwrap_or_default();
        let costs = |filter: &FilterReport| {
            [format!("{:.2}", filter.kernel_ms), shown(self.holes_percent(filter)), shown(spill_percent(filter))]
        };
        cells.extend([&self.nearest, &self.split].into_iter().flat_map(costs));
        cells
    }

    /// Of the exact cells; `None` where holes were not counted.
    fn holes_percent(&self, filter: &FilterReport) -> Option<f64> {
        Some(percent(filter.holes?, self.exact))
    }
}

/// Of the cells that moved voxels reached; `None` where spill was not counted.
fn spill_percent(filter: &FilterReport) -> Option<f64> {
    Some(percent(filter.spill?, filter.leaves))
}
