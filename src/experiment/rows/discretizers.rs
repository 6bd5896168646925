//! What is told of both discretizers: a row each way, on one pose.

use serde::Serialize;

use crate::accuracy::percent;
use crate::engine::FilterReport;
use crate::experiment::Cost;
use crate::experiment::table::{Table, name_of};
use crate::settings::{Discretizer, Filter, Stretching, VoxelizerCells};
use crate::spread::Spread;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiscretizerReport {
    pub scene: String,
    pub time_secs: f64,
    pub turn_degrees: [f64; 3],
    pub grid: u32,
    /// Of every object, whoever shares its mesh.
    pub triangles: u64,
    pub warmup: u32,
    pub runs: u32,
    /// Cells of the exact posed voxelization.
    pub exact: u64,
    pub copy: Option<Cost>,
    pub rows: Vec<DiscretizerRow>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DiscretizerRow {
    pub discretizer: Discretizer,
    /// How the voxelizer finds cells.
    pub cells: Option<VoxelizerCells>,
    pub filter: Filter,
    /// What moving does with objects that stretch.
    pub stretching: Option<Stretching>,
    /// GPU time of moving voxels, or of voxelizing.
    pub discretize: Option<Spread>,
    /// Of the octree, its leaves and its averages.
    pub build: Option<Spread>,
    /// Both, run by run.
    pub rebuild: Option<Spread>,
    /// From the pose to the last count, by the clock: with posing and uploading on the CPU.
    pub clock: Option<Spread>,
    /// Median of both over that of the first row.
    pub ratio: Option<f64>,
    /// Voxels, leaves, holes and spill.
    pub found: Option<FilterReport>,
    /// Why it is not measured.
    pub missing: Option<String>,
}

impl DiscretizerReport {
    const HEADS: [&'static str; 11] = [
        "discretizer",
        "voxels",
        "discretize ms",
        "p5",
        "p95",
        "octree ms",
        "both ms",
        "× transform",
        "clock ms",
        "holes %",
        "spill %",
    ];

    pub(in crate::experiment) fn table(&self) -> Table {
        Table::new("discretizers", &Self::HEADS, self.rows.iter().map(|row| row.text(self.exact)))
    }
}

impl DiscretizerRow {
    /// Of the discretizer, and what tells it from the others.
    pub fn name(&self) -> String {
        let how = self.cells.map_or_else(|| name_of(&self.filter), |cells| name_of(&cells));
        let mixed = if self.stretching == Some(Stretching::Voxelize) { ", stretching voxelized" } else { "" };
        format!("{}, {how}{mixed}", name_of(&self.discretizer))
    }

    fn text(&self, exact: u64) -> Vec<String> {
        let median =
            |spread: Option<Spread>| spread.map_or_else(String::new, |spread| format!("{:.2}", spread.median_ms));
        let share =
            |cells: Option<u64>, of: u64| cells.map_or_else(String::new, |cells| format!("{:.3}", percent(cells, of)));
        let of_found = |of: fn(&FilterReport) -> Option<u64>| self.found.as_ref().and_then(of);
        let leaves = self.found.map_or(0, |found| found.leaves);
        vec![
            self.name(),
            self.found.map_or_else(String::new, |found| found.voxels.to_string()),
            median(self.discretize),
            self.discretize.map_or_else(String::new, |spread| format!("{:.2}", spread.p5_ms)),
            self.discretize.map_or_else(String::new, |spread| format!("{:.2}", spread.p95_ms)),
            median(self.build),
            median(self.rebuild),
            self.ratio.map_or_else(String::new, |ratio| format!("{ratio:.2}")),
            median(self.clock),
            share(of_found(|found| found.holes), exact),
            share(of_found(|found| found.spill), leaves),
        ]
    }
}
