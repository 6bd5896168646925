//! Experiments: several on one GPU find what each finds alone; a cancelled one keeps what it has; what they find is
//! what an engine says.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use octolume::engine::{Engine, FilterReport};
use octolume::experiment::{self, BenchOptions, Experiment, ExperimentError, Found, State, Subject, VoxelRow};
use octolume::gpu::Gpu;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Material, Scene};
use octolume::settings::lighting::SunShines;
use octolume::settings::{Hidden, MotionSettings, Settings, View};
use serde_json::Value;

use crate::device;
use crate::mesh_rig::one_square;

const SLICE: Duration = Duration::from_millis(20);
const RUNS: u32 = 2;
const REBUILD: BenchOptions = BenchOptions { warmup: 1, rebuild: true, light: false, surfaces: false };

/// A square under the sun on a small grid.
fn subject() -> Subject {
    subject_of(one_square(Material::default()))
}

fn subject_of(scene: Scene) -> Subject {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.method.lighting.sun.shines = SunShines::Always;
    let prepared = prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default());
    Subject { prepared: Arc::new(prepared.unwrap_or_else(|error| panic!("{error}"))), settings, runs: RUNS }
}

/// Not turned, and by no simple fraction.
fn poses() -> Vec<MotionSettings> {
    octolume::accuracy::turned(&MotionSettings::default(), &[0.0, 37.0])
}

/// Advances them in turns until all have ended.
fn finish(experiments: &mut [Experiment]) {
    while experiments.iter().any(|experiment| experiment.state() == State::Working) {
        for experiment in experiments.iter_mut() {
            let before = experiment.fraction();
            let state = experiment.advance(SLICE).unwrap_or_else(|error| panic!("{error}"));
            assert!((before..=1.0).contains(&experiment.fraction()), "progress goes on: {}", experiment.doing());
            assert!(state != State::Working || !experiment.doing().is_empty());
            experiment.wait().expect("the GPU is there");
        }
    }
}

fn is_time(name: &str) -> bool {
    let endings = ["_ms", "gb_per_s", "ratio", "date", "frame_wall"];
    endings.iter().any(|ending| name.ends_with(ending))
}

/// A report without its times.
fn timeless(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            let fields = fields.into_iter().filter(|(name, _)| !is_time(name));
            Value::Object(fields.map(|(name, value)| (name, timeless(value))).collect())
        }
        Value::Array(values) => Value::Array(values.into_iter().map(timeless).collect()),
        value => value,
    }
}

fn report(experiment: &Experiment) -> Value {
    timeless(serde_json::to_value(experiment.report()).expect("JSON"))
}

/// What one finds on a device of its own, and the dispatches of that.
fn alone(begin: impl Fn(&Arc<Gpu>) -> Experiment) -> (Value, BTreeMap<String, u64>) {
    let gpu = Arc::new(device::open());
    let mut experiments = [begin(&gpu)];
    finish(&mut experiments);
    (report(&experiments[0]), gpu.counters().dispatches)
}

#[test]
fn experiments_that_take_turns_on_a_gpu_find_what_each_finds_alone() {
    let subject = subject();
    let kernels = |gpu: &Arc<Gpu>| experiment::bench(gpu, subject.clone(), REBUILD);
    let voxels = |gpu: &Arc<Gpu>| experiment::voxels(gpu, subject.clone(), poses(), true);
    let shadows = |gpu: &Arc<Gpu>| experiment::shadows(gpu, subject.clone(), poses());
    let (expected, alone): (Vec<Value>, Vec<_>) = [alone(kernels), alone(voxels), alone(shadows)].into_iter().unzip();
    let gpu = Arc::new(device::open());
    let mut together = [kernels(&gpu), voxels(&gpu), shadows(&gpu)];
    finish(&mut together);
    let names: Vec<String> = together[1].take_pictures().into_iter().map(|picture| picture.name).collect();
    assert_eq!(names.len(), 4, "{names:?}");
    for (experiment, expected) in together.iter().zip(&expected) {
        assert_eq!(experiment.state(), State::Finished);
        assert_eq!(report(experiment), *expected);
    }
    let mut dispatches = BTreeMap::<String, u64>::new();
    alone.into_iter().flatten().for_each(|(kernel, count)| *dispatches.entry(kernel).or_default() += count);
    assert_eq!(gpu.counters().dispatches, dispatches);
}

#[test]
fn a_cancelled_experiment_keeps_its_rows_and_drops_its_engine() {
    let gpu = Arc::new(device::open());
    let rows = |experiment: &Experiment| match experiment.report().found {
        Found::Voxels { rows } => rows,
        _ => Vec::new(),
    };
    let mut experiment = experiment::voxels(&gpu, subject(), poses(), false);
    while rows(&experiment).is_empty() {
        assert_eq!(experiment.changes(), 0, "nothing is found yet");
        assert_eq!(experiment.advance(SLICE).expect("runs"), State::Working);
        experiment.wait().expect("the GPU is there");
    }
    let first = rows(&experiment);
    assert_eq!(experiment.changes(), 1);
    assert!(gpu.bytes_in_use() > 0 && !experiment.report().cancelled);
    experiment.cancel();
    assert_eq!(experiment.advance(SLICE).expect("nothing runs"), State::Cancelled);
    assert_eq!((rows(&experiment), first.len(), experiment.report().cancelled), (first, 1, true));
    // Scratch of jobs is the GPU's own, for whoever comes next.
    let left: Vec<_> = gpu.memory().into_iter().filter(|left| left.label != "job scratch").collect();
    assert_eq!(left, []);
}

#[test]
fn an_experiment_is_cancelled_at_any_moment() {
    let gpu = Arc::new(device::open());
    for steps in (0..40).step_by(5) {
        let mut experiment = experiment::shadows(&gpu, subject(), poses());
        for _ in 0..steps {
            experiment.advance(SLICE).expect("runs");
            experiment.wait().expect("the GPU is there");
        }
        experiment.cancel();
        assert_eq!(experiment.advance(SLICE).expect("nothing runs"), State::Cancelled);
    }
    // The GPU goes on after all that.
    finish(&mut [experiment::bench(&gpu, subject(), REBUILD)]);
}

#[test]
fn an_error_ends_an_experiment_and_is_told_once() {
    let mut subject = subject();
    subject.settings.method.lighting.sun.shines = SunShines::Never;
    let mut experiment = experiment::shadows(&Arc::new(device::open()), subject, poses());
    let error = experiment.advance(SLICE).expect_err("no light");
    assert!(matches!(error, ExperimentError::NoLight(_)), "{error}");
    assert_eq!(experiment.advance(SLICE).expect("told once"), State::Cancelled);
}

#[test]
fn a_scene_without_voxels_is_named_by_every_experiment_that_compares_them() {
    let gpu = Arc::new(device::open());
    let empty = || subject_of(Scene { name: "nothing".to_owned(), ..Scene::default() });
    let voxels = experiment::voxels(&gpu, empty(), poses(), false);
    for mut experiment in [voxels, experiment::shadows(&gpu, empty(), poses())] {
        let error = loop {
            match experiment.advance(SLICE) {
                Ok(state) => assert_eq!(state, State::Working, "no error"),
                Err(error) => break error,
            }
            experiment.wait().expect("the GPU is there");
        };
        assert_eq!(error.to_string(), "nothing has no voxels to compare");
    }
}

/// One filter's report without its times.
fn counts(report: FilterReport) -> FilterReport {
    FilterReport { kernel_ms: 0.0, times: Default::default(), ..report }
}

/// What an engine says of a pose.
fn by_engine(prepared: &Arc<Prepared>, settings: &Settings) -> (u64, [FilterReport; 2]) {
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::clone(prepared)));
    let exact = prepared.exact(&settings.shot.motion, &Hidden::default(), &Progress::default()).expect("voxels");
    engine.offer_exact(Arc::new(exact));
    engine.request(settings, [1, 1]).expect("a frame");
    engine.run_to_end().expect("runs");
    let report = engine.accuracy().expect("is built");
    let filters = [report.nearest, report.split].map(|filter| counts(filter.expect("is measured")));
    (report.exact_cells.expect("is compared"), filters)
}

#[test]
fn holes_and_spill_are_those_of_an_engine() {
    let subject = subject();
    let mut experiments = [experiment::voxels(&Arc::new(device::open()), subject.clone(), poses(), false)];
    finish(&mut experiments);
    let Found::Voxels { rows } = experiments[0].report().found else { panic!("rows of voxels") };
    let mut settings = subject.settings.clone();
    (settings.method.look.view, settings.method.look.accuracy) = (View::Voxels, true);
    for (row, pose) in rows.iter().zip(poses()) {
        settings.shot.motion = pose;
        let VoxelRow { exact, nearest, split, .. } = row.clone();
        assert_eq!((exact, [nearest, split].map(counts)), by_engine(&subject.prepared, &settings));
    }
    assert!(rows[0].turn_degrees != rows[1].turn_degrees && rows[1].nearest.holes > Some(0), "{rows:?}");
}

#[test]
fn kernels_move_the_bytes_that_an_engine_counts() {
    let subject = subject();
    let mut experiments = [experiment::bench(&Arc::new(device::open()), subject.clone(), REBUILD)];
    finish(&mut experiments);
    let Found::Kernels(report) = experiments[0].report().found else { panic!("rows of kernels") };
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::clone(&subject.prepared)));
    let mut settings = subject.settings.clone();
    settings.method.look.view = View::Voxels;
    let mut bytes = BTreeMap::<String, u64>::new();
    engine.request(&settings, [1280, 720]).expect("a frame");
    engine.run_to_end().expect("runs");
    // Not the first: its buffers are as large as was guessed.
    engine.invalidate();
    engine.run_to_end().expect("runs");
    for timing in engine.timings() {
        *bytes.entry(timing.kernel.kernel.clone()).or_default() += timing.kernel.bytes_moved;
    }
    let found = report.kernels.iter().map(|cost| (cost.kernel.clone(), cost.bytes));
    assert_eq!(found.collect::<BTreeMap<_, _>>(), bytes);
    assert_eq!(report.copy.map(|copy| copy.kernel), Some("bench/copy".to_owned()));
}

#[test]
fn shadows_have_a_row_for_every_method() {
    let subject = subject();
    let known = subject.prepared.known_lights(&subject.settings).expect("a pose");
    assert_eq!(known.len(), 1);
    let mut experiments = [experiment::shadows(&Arc::new(device::open()), subject, vec![MotionSettings::default()])];
    finish(&mut experiments);
    let Found::Shadows { rows } = experiments[0].report().found else { panic!("rows of shadows") };
    assert_eq!(rows.len(), 5);
    assert!(rows.iter().all(|row| row.light == known[0].name && row.error.points > 0), "{rows:?}");
}

#[test]
fn both_discretizers_have_a_row_for_every_way() {
    let gpu = Arc::new(device::open());
    let mut experiments = [experiment::discretizers(&gpu, subject(), 1)];
    finish(&mut experiments);
    let Found::Discretizers(report) = experiments[0].report().found else { panic!("another report") };
    let names: Vec<String> = report.rows.iter().map(|row| row.name()).collect();
    assert_eq!(names, ["transform, split", "transform, nearest", "voxelize, sparse", "voxelize, dense"]);
    assert!(report.rows.iter().all(|row| row.missing.is_none() && row.discretize.is_some()));
    assert!(report.exact > 1_000 && report.triangles == 2);
    let [.., sparse, dense] = &report.rows[..] else { panic!("two of the voxelizer") };
    let [sparse, dense] = [sparse, dense].map(|row| counts(row.found.expect("it is compared")));
    assert_eq!(sparse, dense);
    assert_eq!((sparse.holes, sparse.leaves), (Some(0), report.exact));
}
