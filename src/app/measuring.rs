//! Experiments of the window: what is chosen, the one on its way, and the last one's report with what it is of.
//!
//! ```text
//! Order ─► Measuring ─► Experiment (an engine of its own on the window's GPU) ─► Report ─► panel, clipboard, file
//! ```
//!
//! An experiment measures the scene and the moment as they are when it is started; a frame of the window gives it a
//! slice of GPU time beside the picture's.

use std::sync::Arc;
use std::time::Duration;

use crate::experiment::{self, BenchOptions, Experiment, Report, State, Subject, Table};
use crate::gpu::Gpu;
use crate::prepare::Prepared;
use crate::settings::{Discretization, Look, Settings, View};

/// Rebuilds before those that are measured.
const WARMUP: u32 = 1;

/// What is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    #[default]
    Kernels,
    Discretizers,
    Light,
    Surfaces,
    Voxels,
    Shadows,
}

/// What a person does with experiments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    Choose(Measure),
    /// Frames that are measured.
    Runs(u32),
    Start,
    Cancel,
    Copy,
    Save,
}

/// What a report is of.
#[derive(Clone)]
pub struct Measured {
    prepared: Arc<Prepared>,
    settings: Settings,
    measure: Measure,
}

impl PartialEq for Measured {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.prepared, &other.prepared)
            && (self.measure, &self.settings) == (other.measure, &other.settings)
    }
}

impl Measured {
    /// `settings`: of the picture that is shown. What the measure does not depend on is as it is at first, so that
    /// a report outlives another view.
    pub fn new(prepared: &Arc<Prepared>, settings: &Settings, measure: Measure) -> Self {
        let mut settings = settings.clone();
        settings.method.look = match measure {
            Measure::Kernels => Look { view: View::Voxels, accuracy: false, ..settings.method.look },
            _ => Look::default(),
        };
        if measure == Measure::Discretizers {
            // Each is measured, whichever is shown.
            let (discretization, usual) = (&mut settings.method.discretization, Discretization::default());
            discretization.discretizer = usual.discretizer;
            (discretization.cells, discretization.filter) = (usual.cells, usual.filter);
            discretization.stretching = usual.stretching;
        }
        if matches!(measure, Measure::Light | Measure::Voxels | Measure::Shadows | Measure::Discretizers) {
            settings.shot.camera = None;
        }
        Self { prepared: Arc::clone(prepared), settings, measure }
    }

    fn begin(&self, gpu: &Arc<Gpu>, runs: u32) -> Experiment {
        let subject = Subject { prepared: Arc::clone(&self.prepared), settings: self.settings.clone(), runs };
        let nothing = BenchOptions { warmup: WARMUP, rebuild: false, light: false, surfaces: false };
        let pose = vec![self.settings.shot.motion.clone()];
        match self.measure {
            Measure::Kernels => experiment::bench(gpu, subject, BenchOptions { rebuild: true, ..nothing }),
            Measure::Discretizers => experiment::discretizers(gpu, subject, WARMUP),
            Measure::Light => experiment::bench(gpu, subject, BenchOptions { light: true, ..nothing }),
            Measure::Surfaces => experiment::bench(gpu, subject, BenchOptions { surfaces: true, ..nothing }),
            Measure::Voxels => experiment::voxels(gpu, subject, pose, false),
            Measure::Shadows => experiment::shadows(gpu, subject, pose),
        }
    }
}

/// What the window shows in a frame.
pub struct ShownScene<'a> {
    pub gpu: &'a Arc<Gpu>,
    pub prepared: &'a Arc<Prepared>,
    pub settings: &'a Settings,
    /// GPU time for the experiment.
    pub budget: Duration,
}

pub struct Measuring {
    pub measure: Measure,
    pub runs: u32,
    is_ordered: bool,
    running: Option<Experiment>,
    /// Of the experiment on its way, else of the last one.
    measured: Option<Measured>,
    report: Option<Report>,
    tables: Vec<Table>,
    /// Those of the experiment that the report has.
    changes: u64,
    is_of_shown: bool,
    /// What that was found out with.
    seen: Option<(Arc<Prepared>, Settings)>,
}

impl Default for Measuring {
    fn default() -> Self {
        Self {
            measure: Measure::default(),
            runs: 5,
            is_ordered: false,
            running: None,
            measured: None,
            report: None,
            tables: Vec::new(),
            changes: 0,
            is_of_shown: false,
            seen: None,
        }
    }
}

impl Measuring {
    pub const RUNS: std::ops::RangeInclusive<u32> = 1..=1000;

    /// Begins with the next frame of the window.
    pub fn start(&mut self) {
        self.is_ordered = true;
    }

    /// What is measured stays.
    pub fn cancel(&mut self) {
        self.is_ordered = false;
        if let Some(mut experiment) = self.running.take() {
            experiment.cancel();
            self.take_report(&experiment);
        }
    }

    /// Once a frame, after the picture: sentences for the log, and an error as the last one.
    pub fn follow(&mut self, ctx: &egui::Context, shown: &ShownScene<'_>) -> (Vec<String>, Result<(), String>) {
        if std::mem::take(&mut self.is_ordered) {
            let measured = Measured::new(shown.prepared, shown.settings, self.measure);
            let experiment = measured.begin(shown.gpu, self.runs);
            self.take_report(&experiment);
            (self.running, self.measured, self.seen) = (Some(experiment), Some(measured), None);
        }
        self.compare(shown);
        let Some(mut experiment) = self.running.take() else { return (Vec::new(), Ok(())) };
        let advanced = experiment.advance(shown.budget).map_err(|error| error.to_string());
        let remarks = experiment.take_remarks().into_iter().map(|remark| remark.sentence().to_owned()).collect();
        let is_over = experiment.state() != State::Working;
        if is_over || experiment.changes() != self.changes {
            self.take_report(&experiment);
        }
        self.running = (!is_over).then_some(experiment);
        ctx.request_repaint();
        (remarks, advanced.map(drop))
    }

    fn take_report(&mut self, experiment: &Experiment) {
        let report = experiment.report();
        (self.changes, self.tables, self.report) = (experiment.changes(), report.tables(), Some(report));
    }

    /// Whether the report is of what is shown: found out anew where another scene or other settings are shown.
    fn compare(&mut self, shown: &ShownScene<'_>) {
        let Some(measured) = &self.measured else { return };
        let is_shown = |(prepared, settings): &(Arc<Prepared>, Settings)| {
            Arc::ptr_eq(prepared, shown.prepared) && settings == shown.settings
        };
        if !self.seen.as_ref().is_some_and(is_shown) {
            self.is_of_shown = *measured == Measured::new(shown.prepared, shown.settings, measured.measure);
            self.seen = Some((Arc::clone(shown.prepared), shown.settings.clone()));
        }
    }

    /// How far it is between 0 and 1, and what it does.
    pub fn progress(&self) -> Option<(f32, String)> {
        self.running.as_ref().map(|experiment| (experiment.fraction(), experiment.doing()))
    }

    /// Of the experiment on its way as far as it is, else of the last one.
    pub fn report(&self) -> Option<&Report> {
        self.report.as_ref()
    }

    /// Of the report.
    pub fn tables(&self) -> &[Table] {
        &self.tables
    }

    /// Whether the report is of what is shown.
    pub fn is_of_shown(&self) -> bool {
        self.is_of_shown
    }

    pub fn is_busy(&self) -> bool {
        self.is_ordered || self.running.is_some()
    }

    /// Of the report's file.
    pub fn name(&self) -> Option<String> {
        let (measured, report) = (self.measured.as_ref()?, self.report.as_ref()?);
        Some(format!("{}-{}", measured.prepared.scene.name, report.experiment))
    }

    pub fn json(&self) -> Option<String> {
        serde_json::to_string_pretty(self.report.as_ref()?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepare::prepare;
    use crate::progress::Progress;
    use crate::scene::Scene;

    #[test]
    fn a_report_outlives_what_it_does_not_depend_on() {
        let settings = Settings::default();
        let prepared = prepare(Arc::new(Scene::default()), &settings.method.discretization, None, &Progress::default());
        let prepared = Arc::new(prepared.expect("nothing to voxelize"));
        let mut sliced = settings.clone();
        sliced.method.look = Look { view: View::Slice, level: Some(3), ..Look::default() };
        let mut later = settings.clone();
        later.shot.motion.time_secs = 1.0;
        let of = |settings: &Settings, measure| Measured::new(&prepared, settings, measure);
        assert!(of(&settings, Measure::Voxels) == of(&sliced, Measure::Voxels));
        assert!(of(&settings, Measure::Kernels) != of(&sliced, Measure::Kernels), "the level that is drawn");
        assert!(of(&settings, Measure::Voxels) != of(&later, Measure::Voxels));
        assert!(of(&settings, Measure::Voxels) != of(&settings, Measure::Shadows));
    }
}
