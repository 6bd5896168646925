//! What is told of lit surfaces: a row a way to light them.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::experiment::surface_work::SurfaceWork;
use crate::experiment::table::Table;
use crate::settings::ConeTracing;
use crate::spread::Spread;

#[derive(Clone, Debug, Serialize)]
pub struct SurfaceReport {
    pub size_px: [u32; 2],
    pub variants: Vec<VariantCost>,
}

/// Median times of a way to light surfaces.
#[derive(Clone, Debug, Serialize)]
pub struct VariantCost {
    pub name: &'static str,
    pub cones: ConeTracing,
    /// Of kernels that nothing but surfaces needs.
    pub kernels_ms: BTreeMap<String, f64>,
    /// Diffuse cones and filter.
    pub diffuse_ms: f64,
    /// Of all kernels behind surfaces, per run.
    pub total: Spread,
    #[serde(skip)]
    pub works_ms: BTreeMap<SurfaceWork, f64>,
}

impl SurfaceReport {
    pub(in crate::experiment) fn table(&self) -> Table {
        let heads: Vec<&str> =
            ["ms"].into_iter().chain(SurfaceWork::ALL.map(SurfaceWork::name)).chain(["total"]).collect();
        let rows = self.variants.iter().map(|variant| {
            let works = SurfaceWork::ALL.map(|work| variant.works_ms.get(&work).copied().unwrap_or(0.0));
            let numbers = works.into_iter().chain([variant.total.median_ms]).map(|ms| format!("{ms:.1}"));
            [variant.name.to_owned()].into_iter().chain(numbers).collect()
        });
        Table::new("surfaces", &heads, rows)
    }
}
