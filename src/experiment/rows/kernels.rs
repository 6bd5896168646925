//! What is told of kernels beside what their memory traffic alone would cost.

use serde::Serialize;

use super::light::LightReport;
use super::surfaces::SurfaceReport;
use crate::experiment::cost::Cost;
use crate::experiment::table::Table;
use crate::spread::Spread;

#[derive(Clone, Serialize)]
pub struct KernelReport {
    pub scene: String,
    pub warmup: u32,
    pub runs: u32,
    pub span: f64,
    pub voxels: u64,
    pub voxelize_ms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copy: Option<Cost>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub kernels: Vec<Cost>,
    /// All kernels but those that draw, per rebuild.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rebuild: Option<Cost>,
    /// From the request to the finished picture, by the clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_wall: Option<Spread>,
    /// What light costs, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light: Option<LightReport>,
    /// What lit surfaces cost, by variant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<SurfaceReport>,
}

impl KernelReport {
    pub(in crate::experiment) fn tables(&self) -> Vec<Table> {
        let costs = self.kernels.iter().chain(&self.rebuild).chain(&self.copy);
        let kernels = Table::new("kernels", &Cost::HEADS, costs.map(Cost::cells));
        let more = self.light.iter().flat_map(LightReport::tables);
        let kernels = Some(kernels).filter(|table| !table.rows.is_empty());
        kernels.into_iter().chain(more).chain(self.surfaces.iter().map(SurfaceReport::table)).collect()
    }
}
