//! What an experiment found, with what it was found on.

use std::time::SystemTime;

use serde::Serialize;

use super::table::Table;
use super::{DiscretizerReport, KernelReport, RenderingRow, ShadowRow, VoxelRow};
use crate::settings::Settings;

#[derive(Clone, Serialize)]
pub struct Report {
    pub experiment: &'static str,
    pub octolume: &'static str,
    /// When it was begun, RFC 3339.
    pub date: String,
    pub adapter: String,
    pub driver: String,
    /// As asked; what a row changes of them, it tells itself.
    pub settings: Settings,
    /// It did not come to its end, and rows are missing.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub cancelled: bool,
    #[serde(flatten)]
    pub found: Found,
}

/// The rows of every experiment.
#[derive(Clone, Serialize)]
#[serde(untagged)]
pub enum Found {
    Kernels(Box<KernelReport>),
    Discretizers(Box<DiscretizerReport>),
    Voxels { rows: Vec<VoxelRow> },
    Shadows { rows: Vec<ShadowRow> },
    Rendering { rows: Vec<RenderingRow> },
}

impl From<KernelReport> for Found {
    fn from(report: KernelReport) -> Self {
        Self::Kernels(Box::new(report))
    }
}

impl From<DiscretizerReport> for Found {
    fn from(report: DiscretizerReport) -> Self {
        Self::Discretizers(Box::new(report))
    }
}

impl From<Vec<VoxelRow>> for Found {
    fn from(rows: Vec<VoxelRow>) -> Self {
        Self::Voxels { rows }
    }
}

impl From<Vec<ShadowRow>> for Found {
    fn from(rows: Vec<ShadowRow>) -> Self {
        Self::Shadows { rows }
    }
}

impl From<Vec<RenderingRow>> for Found {
    fn from(rows: Vec<RenderingRow>) -> Self {
        Self::Rendering { rows }
    }
}

impl Report {
    pub(super) fn new(
        experiment: &'static str,
        adapter: &wgpu::AdapterInfo,
        settings: &Settings,
        found: Found,
    ) -> Self {
        Self {
            experiment,
            octolume: env!("CARGO_PKG_VERSION"),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            adapter: adapter.name.clone(),
            driver: format!("{} {}", adapter.driver, adapter.driver_info),
            settings: settings.clone(),
            cancelled: false,
            found,
        }
    }

    /// Takes the rows of the same experiment over another scene or grid in behind its own.
    pub fn append(&mut self, other: Self) {
        self.cancelled |= other.cancelled;
        match (&mut self.found, other.found) {
            (Found::Voxels { rows }, Found::Voxels { rows: more }) => rows.extend(more),
            (Found::Shadows { rows }, Found::Shadows { rows: more }) => rows.extend(more),
            (Found::Rendering { rows }, Found::Rendering { rows: more }) => rows.extend(more),
            // One rebuild of kernels is one report.
            _ => {}
        }
    }

    pub fn tables(&self) -> Vec<Table> {
        match &self.found {
            Found::Kernels(report) => report.tables(),
            Found::Discretizers(report) => vec![report.table()],
            Found::Voxels { rows } => vec![VoxelRow::table(rows)],
            Found::Shadows { rows } => vec![ShadowRow::table(rows)],
            Found::Rendering { rows } => vec![RenderingRow::table(rows)],
        }
    }
}
