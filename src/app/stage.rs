//! Drives the engine once a frame of the window: asks for the picture, gives it a slice of GPU
//! time, and keeps what the panels show of the last frame that ran.

use std::sync::Arc;

use super::coarseness::Coarseness;
use super::history::FrameHistory;
use super::pace::Pace;
use crate::engine::{AccuracyReport, Engine, EngineError, EngineState, OctreeReport, PassTiming};
use crate::gpu::{Gpu, GpuTexture};
use crate::plan::{FramePlan, Part, Pass};
use crate::prepare::{ExactVoxels, Prepared};
use crate::settings::Settings;

pub struct Stage {
    pub engine: Engine,
    pub pace: Pace,
    pub history: FrameHistory,
    /// Of what is shown.
    pub timings: Vec<PassTiming>,
    /// The last frame that ran.
    pub last_frame: u64,
    pub plan: FramePlan,
    /// Counts the results that were finished.
    pub results: u64,
    /// Counts those of them that changed the octree, its pointers or its light.
    pub builds: u64,
    /// Of the last octree that was finished.
    pub octree: Option<OctreeReport>,
    pub accuracy: Option<AccuracyReport>,
    /// What light was multiplied by before the last picture showed it.
    pub exposure: f64,
    /// Ends of the colour scale of the last slice or shadow map.
    pub value_range: Option<[f64; 2]>,
    /// Objects that the last pose asked for cannot show, a sentence each.
    left_out: Vec<String>,
    /// Those of them that the pose before could show.
    newly_left_out: Vec<String>,
    state: State,
    /// What the engine was asked for last.
    asked: Option<(Settings, [u32; 2])>,
    /// What a pixel of the last picture cost.
    ms_per_pixel: f64,
    coarseness: Coarseness,
    /// The last picture that was finished.
    finished: Option<GpuTexture>,
}

enum State {
    Idle,
    Working {
        fraction: f32,
    },
    /// The picture that was asked for cannot be made; it is not tried again.
    Failed {
        error: String,
    },
}

impl Stage {
    pub fn new(gpu: Arc<Gpu>) -> Self {
        Self {
            engine: Engine::new(gpu),
            pace: Pace::default(),
            history: FrameHistory::default(),
            timings: Vec::new(),
            last_frame: 0,
            plan: FramePlan::default(),
            results: 0,
            builds: 0,
            octree: None,
            accuracy: None,
            exposure: 1.0,
            value_range: None,
            left_out: Vec::new(),
            newly_left_out: Vec::new(),
            state: State::Idle,
            asked: None,
            ms_per_pixel: 0.0,
            coarseness: Coarseness::default(),
            finished: None,
        }
    }

    /// Another scene, or other voxels of it.
    pub fn set_prepared(&mut self, prepared: &Arc<Prepared>) {
        self.engine.set_prepared(Some(Arc::clone(prepared)));
        (self.state, self.asked, self.finished) = (State::Idle, None, None);
        (self.octree, self.accuracy) = (None, None);
        self.left_out.clear();
    }

    /// Exact voxels of some pose: of the one that is shown, they are compared at once.
    pub fn offer_exact(&mut self, exact: Arc<ExactVoxels>) {
        self.engine.offer_exact(exact);
        self.asked = None;
    }

    /// Asks for a picture and works on it for a while, shorter while input arrives. An error is told
    /// once, as one sentence.
    pub fn advance(&mut self, settings: &Settings, size_px: [u32; 2], input: bool) -> Result<(), String> {
        let asked = self.asked.as_ref().is_some_and(|(asked, asked_px)| asked == settings && *asked_px == size_px);
        if size_px.contains(&0) || asked && !matches!(self.state, State::Working { .. }) {
            return Ok(());
        }
        let budget = if input { self.pace.budget_under_input } else { self.pace.budget };
        match self.ask(settings, size_px, asked).and_then(|()| self.engine.advance(budget)) {
            Ok(state) => self.advanced(state),
            Err(error) => {
                self.state = State::Failed { error: error.to_string() };
                return Err(error.to_string());
            }
        }
        Ok(())
    }

    fn advanced(&mut self, state: EngineState) {
        let finished = self.engine.last_frame().filter(|(number, _)| *number > self.last_frame);
        if let Some((number, plan)) = finished.map(|(number, plan)| (number, plan.clone())) {
            (self.last_frame, self.plan) = (number, plan);
            self.take_results();
            self.note_costs();
        }
        self.state = match state {
            EngineState::Working { fraction } => State::Working { fraction },
            EngineState::Idle => {
                if self.engine.shows_nothing() {
                    self.plan.clone_from(self.engine.plan());
                }
                self.take_results();
                State::Idle
            }
        };
    }

    fn ask(&mut self, settings: &Settings, size_px: [u32; 2], asked: bool) -> Result<(), EngineError> {
        if asked {
            return Ok(());
        }
        self.asked = Some((settings.clone(), size_px));
        self.engine.request(settings, size_px)?;
        let left_out = self.engine.left_out();
        self.newly_left_out.extend(left_out.iter().filter(|&sentence| !self.left_out.contains(sentence)).cloned());
        self.left_out = left_out;
        Ok(())
    }

    /// Objects left out since this was asked last, a sentence each: said when they leave, not every frame.
    pub fn take_newly_left_out(&mut self) -> Vec<String> {
        std::mem::take(&mut self.newly_left_out)
    }

    /// How far the frame is that the GPU works on.
    pub fn working(&self) -> Option<f32> {
        match self.state {
            State::Working { fraction } => Some(fraction),
            _ => None,
        }
    }

    /// Why there is no picture of what was asked for.
    pub fn error(&self) -> Option<&str> {
        match &self.state {
            State::Failed { error } => Some(error),
            _ => None,
        }
    }

    /// The picture to show: the last one that was finished.
    pub fn picture(&self) -> Option<&GpuTexture> {
        self.finished.as_ref()
    }

    /// What each edge of a moving picture is to be divided by.
    pub fn moving_coarseness(&mut self, full_px: [u32; 2]) -> u32 {
        self.coarseness.next(self.ms_per_pixel, full_px)
    }

    /// Takes down what the last frame has cost.
    fn note_costs(&mut self) {
        let building = [Pass::MarkLeaves, Pass::LinkNodes, Pass::AverageLight, Pass::Bounces];
        self.builds += u64::from(building.into_iter().any(|pass| self.plan.runs(pass)));
        self.history.push(&self.timings, self.last_frame);
        let drawn = self.timings.iter().filter(|timing| timing.frame == self.last_frame);
        let is_seen = |timing: &&PassTiming| timing.pass.parts().iter().any(|part| Part::SEEN.contains(part));
        let view_ms: f64 = drawn.filter(is_seen).map(|timing| timing.kernel.ms).sum();
        if let Some(picture) = self.finished.as_ref().filter(|_| view_ms > 0.0) {
            let [width, height] = picture.size_px().map(f64::from);
            self.ms_per_pixel = view_ms / (width * height);
        }
    }

    fn take_results(&mut self) {
        self.results += 1;
        self.timings = self.engine.timings().to_vec();
        self.octree = self.engine.octree_report().cloned();
        self.accuracy = self.engine.accuracy();
        self.exposure = self.engine.exposure();
        self.value_range = self.engine.value_range();
        self.finished = self.engine.image().cloned();
    }
}
