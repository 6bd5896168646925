//! What lit surfaces cost, pass by pass, against number and aperture of cones, resolution and sampling.

use std::collections::BTreeMap;

use crate::experiment::ExperimentError;
use crate::experiment::board::{Findings, Share};
use crate::experiment::frames::{Forget, Frames, Times};
use crate::experiment::lab::{Lab, PICTURE_PX};
use crate::experiment::rows::{KernelReport, SurfaceReport, VariantCost};
use crate::experiment::surface_work::{self, SurfaceWork};
use crate::settings::{Lookup, Sampling, Settings, SurfaceView, View};
use crate::spread::Spread;

type Change = fn(&mut Settings);

const VARIANTS: [(&str, Change); 18] = [
    ("as set", |_| {}),
    ("1 cone a pixel", |s| s.method.cone_tracing.cones = 1),
    ("2 cones a pixel", |s| s.method.cone_tracing.cones = 2),
    ("8 cones a pixel", |s| s.method.cone_tracing.cones = 8),
    ("16 cones a pixel", |s| s.method.cone_tracing.cones = 16),
    ("aperture 10", |s| s.method.cone_tracing.cone_degrees = 10.0),
    ("aperture 20", |s| s.method.cone_tracing.cone_degrees = 20.0),
    ("aperture 60", |s| s.method.cone_tracing.cone_degrees = 60.0),
    ("whole resolution", |s| s.method.cone_tracing.half_resolution = false),
    ("whole, no pattern", |s| {
        s.method.cone_tracing.half_resolution = false;
        s.method.cone_tracing.pattern_px = 1;
    }),
    ("steps of 1/2 diameter", |s| s.method.cone_tracing.step_diameters = 0.5),
    ("nearest samples", |s| s.method.cone_tracing.sampling = Sampling::Nearest),
    ("trilinear samples", |s| s.method.cone_tracing.sampling = Sampling::Trilinear),
    ("pointers a block", |s| s.method.cone_tracing.lookup = Lookup::BlockPointers),
    ("pointers a node", |s| s.method.cone_tracing.lookup = Lookup::NodePointers),
    ("occlusion alone", |s| s.method.look.surface = SurfaceView::Ao),
    ("specular cones alone", |s| s.method.cone_tracing.diffuse = false),
    ("every surface glossy", |s| s.method.cone_tracing.glossy_roughness = 1.0),
];

pub async fn measure(lab: &mut Lab, report: &Findings<KernelReport>, share: Share) -> Result<(), ExperimentError> {
    report.borrow_mut().surfaces = Some(SurfaceReport { size_px: PICTURE_PX, variants: Vec::new() });
    let mut shown = lab.settings.clone();
    (shown.method.look.view, shown.method.look.surface) = (View::Surfaces, SurfaceView::Final);
    for (index, (name, change)) in VARIANTS.into_iter().enumerate() {
        let mut settings = shown.clone();
        change(&mut settings);
        match measure_variant(lab, (name, &settings), share.part(index, VARIANTS.len())).await {
            Ok(cost) => report.borrow_mut().surfaces.iter_mut().for_each(|found| found.variants.push(cost.clone())),
            Err(error) => lab.miss(name, &error),
        }
    }
    Ok(())
}

async fn measure_variant(
    lab: &mut Lab,
    (name, settings): (&'static str, &Settings),
    share: Share,
) -> Result<VariantCost, ExperimentError> {
    let (mut times, mut totals) = (Times::default(), Vec::new());
    let frames = Frames {
        what: name,
        settings,
        size_px: PICTURE_PX,
        forget: Forget::Surfaces,
        warmup: lab.warmup,
        runs: lab.runs,
    };
    lab.measure(frames, share, |engine, _| {
        times.add(surface_work::kernels(engine.timings()));
        totals.push(SurfaceWork::sum_ms(&SurfaceWork::ALL, engine.timings()));
    })
    .await?;
    let (mut kernels_ms, mut works_ms) = (BTreeMap::new(), BTreeMap::new());
    for ((work, kernel), ms) in times.medians() {
        *works_ms.entry(work).or_insert(0.0) += ms;
        if SurfaceWork::owns(&kernel) {
            *kernels_ms.entry(kernel).or_insert(0.0) += ms;
        }
    }
    let diffuse = [SurfaceWork::Diffuse, SurfaceWork::Filter];
    Ok(VariantCost {
        name,
        cones: settings.method.cone_tracing,
        kernels_ms,
        diffuse_ms: diffuse.iter().filter_map(|work| works_ms.get(work)).fold(0.0, |sum, ms| sum + ms),
        total: Spread::of(&totals).ok_or_else(|| ExperimentError::NoTimes(name.to_owned()))?,
        works_ms,
    })
}
