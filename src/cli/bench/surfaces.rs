//! What lit surfaces cost, pass by pass, against number and aperture of cones, resolution and sampling.

use anyhow::Context;
use octolume::settings::{ConeTracing, Lookup, Sampling, Settings, SurfaceView, View};
use serde::Serialize;

use super::SIZE_PX;
use crate::cli::output;
use crate::cli::session::Session;
use crate::cli::surface_times::{self, KernelMs, sum};
use octolume::spread::Spread;

/// Folders of the kernels behind the view.
const KERNELS: [&str; 2] = ["surface/", "cones/"];
/// Columns of the table; kernels that begin with the second are added up.
const COLUMNS: [(&str, &[&str]); 6] = [
    ("surfaces", &["surface/draw"]),
    ("direct", &["surface/emission", "surface/direct"]),
    ("diffuse", &["cones/diffuse"]),
    ("filter", &["cones/blur", "cones/upsample"]),
    ("specular", &["cones/glossy", "cones/list", "cones/specular"]),
    ("compose", &["surface/compose", "surface/sum"]),
];

#[derive(Serialize)]
pub struct SurfaceReport {
    size_px: [u32; 2],
    variants: Vec<VariantCost>,
}

/// Median times of a way to light surfaces.
#[derive(Serialize)]
struct VariantCost {
    name: &'static str,
    cones: ConeTracing,
    kernels_ms: KernelMs,
    /// Diffuse cones and filter.
    diffuse_ms: f64,
    /// Of all kernels of the view, per run.
    total: Spread,
}

type Change = fn(&mut Settings);

const VARIANTS: [(&str, Change); 18] = [
    ("as set", |_| {}),
    ("1 cone a pixel", |s| s.cone_tracing.cones = 1),
    ("2 cones a pixel", |s| s.cone_tracing.cones = 2),
    ("8 cones a pixel", |s| s.cone_tracing.cones = 8),
    ("16 cones a pixel", |s| s.cone_tracing.cones = 16),
    ("aperture 10", |s| s.cone_tracing.cone_degrees = 10.0),
    ("aperture 20", |s| s.cone_tracing.cone_degrees = 20.0),
    ("aperture 60", |s| s.cone_tracing.cone_degrees = 60.0),
    ("whole resolution", |s| s.cone_tracing.half_resolution = false),
    ("whole, no pattern", |s| {
        s.cone_tracing.half_resolution = false;
        s.cone_tracing.pattern_px = 1;
    }),
    ("steps of 1/2 diameter", |s| s.cone_tracing.step_diameters = 0.5),
    ("nearest samples", |s| s.cone_tracing.sampling = Sampling::Nearest),
    ("trilinear samples", |s| s.cone_tracing.sampling = Sampling::Trilinear),
    ("pointers a block", |s| s.cone_tracing.lookup = Lookup::BlockPointers),
    ("pointers a node", |s| s.cone_tracing.lookup = Lookup::NodePointers),
    ("occlusion alone", |s| s.look.surface = SurfaceView::Ao),
    ("specular cones alone", |s| s.cone_tracing.diffuse = false),
    ("every surface glossy", |s| s.cone_tracing.glossy_roughness = 1.0),
];

/// `runs`: to warm up, and measured.
pub fn measure(session: &mut Session, settings: &Settings, runs: (u32, u32)) -> anyhow::Result<SurfaceReport> {
    let mut shown = settings.clone();
    shown.look.view = View::Surfaces;
    shown.look.surface = SurfaceView::Final;
    let mut variants = Vec::new();
    for (name, change) in VARIANTS {
        let mut settings = shown.clone();
        change(&mut settings);
        match measure_variant(session, name, &settings, runs) {
            Ok(cost) => variants.push(cost),
            Err(error) => output::message(&format!("{name} is not measured: {error:#}")),
        }
    }
    Ok(SurfaceReport { size_px: SIZE_PX, variants })
}

fn measure_variant(
    session: &mut Session,
    name: &'static str,
    settings: &Settings,
    runs: (u32, u32),
) -> anyhow::Result<VariantCost> {
    let measured = surface_times::measure(session, settings, SIZE_PX, runs)?;
    let totals: Vec<f64> = measured.iter().map(|of_run| sum(of_run, &KERNELS)).collect();
    let mut kernels_ms = surface_times::medians(&measured);
    kernels_ms.retain(|kernel, _| KERNELS.iter().any(|folder| kernel.starts_with(folder)));
    Ok(VariantCost {
        name,
        cones: settings.cone_tracing,
        diffuse_ms: sum(&kernels_ms, COLUMNS[2].1) + sum(&kernels_ms, COLUMNS[3].1),
        kernels_ms,
        total: Spread::of(&totals).context("no run was measured")?,
    })
}

impl SurfaceReport {
    pub fn text(&self) -> String {
        let heads: Vec<&str> = ["ms"].into_iter().chain(COLUMNS.map(|(head, _)| head)).chain(["total"]).collect();
        let rows = self.variants.iter().map(|variant| {
            let columns = COLUMNS.map(|(_, starts)| format!("{:.1}", sum(&variant.kernels_ms, starts)));
            let total = format!("{:.1}", variant.total.median_ms);
            [variant.name.to_owned()].into_iter().chain(columns).chain([total]).collect()
        });
        let [width, height] = self.size_px;
        format!("lit surfaces, {width} x {height} pixels\n\n{}", output::table(&heads, rows))
    }
}
