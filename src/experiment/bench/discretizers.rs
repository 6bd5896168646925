//! Both discretizers on one pose: what each takes to bring voxels into the grid, what the octree behind it takes, and the
//! cells it misses. In turns, so that what slows the machine slows all alike.

use std::sync::Arc;
use std::time::Instant;

use super::copy;
use crate::engine::{Engine, PassTiming};
use crate::experiment::board::{Findings, Share};
use crate::experiment::lab::{Lab, NO_PICTURE, pause};
use crate::experiment::rows::{DiscretizerReport, DiscretizerRow};
use crate::experiment::{Experiment, ExperimentError, Subject};
use crate::gpu::Gpu;
use crate::plan::Part;
use crate::prepare::{Prepared, PreparedObject};
use crate::settings::{Discretizer, Filter, Settings, Stretching, View, VoxelizerCells};
use crate::spread::Spread;

/// A discretizer, and what is open about it.
#[derive(Clone, Copy)]
enum Way {
    Transform(Filter, Stretching),
    /// Its voxels lie wholly in their cells: filters do not change them.
    Voxelize(VoxelizerCells),
}

/// What is measured beside each other: what stretches is voxelized where something does.
fn ways(prepared: &Prepared) -> Vec<Way> {
    let mix = prepared.objects.iter().any(|object| object.unmovable.is_some());
    let moved = [Filter::Split, Filter::Nearest].map(|filter| Way::Transform(filter, Stretching::Move));
    let mixed = mix.then_some(Way::Transform(Filter::Split, Stretching::Voxelize));
    let voxelized = [VoxelizerCells::Sparse, VoxelizerCells::Dense].map(Way::Voxelize);
    moved.into_iter().chain(mixed).chain(voxelized).collect()
}

/// One way, and what its frames took.
struct Variant {
    settings: Settings,
    row: DiscretizerRow,
    discretize_ms: Vec<f64>,
    build_ms: Vec<f64>,
    both_ms: Vec<f64>,
    clock_ms: Vec<f64>,
}

/// Both discretizers on the subject's pose. `warmup`: frames of each that are not measured.
pub fn discretizers(gpu: &Arc<Gpu>, mut subject: Subject, warmup: u32) -> Experiment {
    let look = &mut subject.settings.method.look;
    (look.view, look.accuracy) = (View::Voxels, false);
    subject.settings.shot.size_px = None;
    let report = DiscretizerReport {
        scene: subject.prepared.scene.name.clone(),
        time_secs: subject.settings.shot.motion.time_secs,
        turn_degrees: subject.settings.shot.motion.turn_degrees,
        grid: subject.settings.method.discretization.grid,
        triangles: drawn_triangles(&subject.prepared),
        warmup,
        runs: subject.runs,
        exact: 0,
        copy: None,
        rows: Vec::new(),
    };
    Experiment::begin(gpu, ("discretizers", subject), report, async move |mut lab, report| {
        lab.warmup = warmup;
        measure(lab, &report).await
    })
}

/// Of every object, whoever shares its mesh.
fn drawn_triangles(prepared: &Prepared) -> u64 {
    let of = |object: &PreparedObject| prepared.scene.meshes[object.object.mesh].triangle_count() as u64;
    prepared.objects.iter().map(of).sum()
}

async fn measure(mut lab: Lab, report: &Findings<DiscretizerReport>) -> Result<(), ExperimentError> {
    let frames = (lab.warmup + lab.runs) as f32;
    let [copying, voxelizing, timing, comparing] = Share::WHOLE.split([1.0, 2.0, 2.0 * frames, 4.0]);
    let copied = copy::measure(&lab, copying).await?;
    report.borrow_mut().copy = Some(copied);
    lab.take_exact(&lab.settings.clone(), voxelizing).await?;
    let ways = ways(&lab.prepared);
    let mut variants: Vec<Variant> = ways.iter().map(|way| Variant::new(&lab.settings, *way)).collect();
    for run in 0..lab.warmup + lab.runs {
        let of_run = timing.part(run as usize, (lab.warmup + lab.runs) as usize);
        for (number, variant) in variants.iter_mut().enumerate() {
            let share = of_run.part(number, ways.len());
            lab.say(share, format!("discretizing: {} of {}", run + 1, lab.warmup + lab.runs));
            let counts = run >= lab.warmup;
            variant.run(&mut lab, share, counts).await?;
        }
    }
    let mut first_ms = None;
    for (number, variant) in variants.into_iter().enumerate() {
        let row = variant.row(&mut lab, (comparing.part(number, ways.len()), first_ms)).await?;
        first_ms = first_ms.or(row.rebuild.map(|rebuild| rebuild.median_ms));
        let mut report = report.borrow_mut();
        report.exact = lab.engine.accuracy().and_then(|accuracy| accuracy.exact_cells).unwrap_or(report.exact);
        report.rows.push(row);
    }
    Ok(())
}

impl Variant {
    fn new(settings: &Settings, way: Way) -> Self {
        let mut settings = settings.clone();
        let discretization = &mut settings.method.discretization;
        let mut row = DiscretizerRow::default();
        match way {
            Way::Transform(filter, stretching) => {
                (row.discretizer, row.filter, row.stretching) = (Discretizer::Transform, filter, Some(stretching));
                discretization.stretching = stretching;
            }
            Way::Voxelize(cells) => {
                (row.discretizer, row.filter, row.cells) = (Discretizer::Voxelize, Filter::Nearest, Some(cells));
                discretization.cells = cells;
            }
        }
        (discretization.discretizer, discretization.filter) = (row.discretizer, row.filter);
        let (discretize_ms, build_ms, both_ms, clock_ms) = Default::default();
        Self { settings, row, discretize_ms, build_ms, both_ms, clock_ms }
    }

    /// A frame from the pose on. What does not fit the adapter is not tried again.
    async fn run(&mut self, lab: &mut Lab, share: Share, counts: bool) -> Result<(), ExperimentError> {
        if self.row.missing.is_some() {
            return Ok(());
        }
        lab.engine.invalidate();
        let started = Instant::now();
        match lab.run(&self.settings, NO_PICTURE, share).await {
            Err(error) if error.is_of_room() => {
                lab.miss(&self.row.name(), &error);
                self.row.missing = Some(error.to_string());
            }
            outcome => outcome?,
        }
        if counts && self.row.missing.is_none() {
            self.clock_ms.push(started.elapsed().as_secs_f64() * 1e3);
            let [discretize, build] = [&Part::DISCRETIZED[..], &Part::BUILT].map(|parts| took(&lab.engine, parts));
            self.discretize_ms.push(discretize);
            self.build_ms.push(build);
            self.both_ms.push(discretize + build);
        }
        pause().await;
        Ok(())
    }

    /// With the cells that are missed, from a frame that is not timed. `first_ms`: what the first variant takes.
    async fn row(
        self,
        lab: &mut Lab,
        (share, first_ms): (Share, Option<f64>),
    ) -> Result<DiscretizerRow, ExperimentError> {
        let rebuild = Spread::of(&self.both_ms);
        let mut row = DiscretizerRow {
            discretize: Spread::of(&self.discretize_ms),
            build: Spread::of(&self.build_ms),
            rebuild,
            clock: Spread::of(&self.clock_ms),
            ratio: rebuild.zip(first_ms).map(|(rebuild, first)| rebuild.median_ms / first),
            ..self.row
        };
        if row.missing.is_none() {
            lab.say(share, "comparing with exact voxels");
            let mut settings = self.settings;
            settings.method.look.accuracy = true;
            lab.run(&settings, NO_PICTURE, share).await?;
            row.found = lab.engine.accuracy().and_then(|report| report.of(row.filter));
        }
        Ok(row)
    }
}

fn took(engine: &Engine, parts: &[Part]) -> f64 {
    let is_of = |timing: &&PassTiming| timing.pass.parts().iter().any(|part| parts.contains(part));
    engine.timings().iter().filter(is_of).map(|timing| timing.kernel.ms).sum()
}
