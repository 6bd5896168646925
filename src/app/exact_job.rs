//! The exact voxelization behind ghost and accuracy, on a thread of its own.
//!
//! Exact and moved voxels must show one pose. Where the exact set takes a blink, the picture waits
//! for it and follows the timeline pose by pose; where it takes longer, the moved voxels go ahead
//! alone and the exact set joins them when the pose rests.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::background::{Background, Outcome};
use super::pace::Pace;
use crate::prepare::{ExactError, ExactVoxels, Prepared};
use crate::settings::{MotionSettings, Settings, Visibility};

/// A pose that stays this long rests.
pub const REST: Duration = Duration::from_millis(200);

/// What an exact set depends on, beside the scene: which objects are posed, and how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Posed {
    pub motion: MotionSettings,
    pub visibility: Visibility,
}

impl Posed {
    pub fn of(settings: &Settings) -> Self {
        Self { motion: settings.shot.motion.clone(), visibility: settings.shot.visibility.clone() }
    }
}

#[derive(Default)]
pub struct ExactJob {
    pub pace: Pace,
    running: Option<Running>,
    /// The pose of the set that the engine has.
    shown: Option<Posed>,
    scene: Option<Arc<Prepared>>,
    /// How long the last set took; zero before the first.
    took: Duration,
    wanted: Option<Posed>,
    wanted_since: Option<Instant>,
}

struct Running {
    posed: Posed,
    started: Instant,
    work: Background<Result<ExactVoxels, ExactError>>,
}

/// What a frame must tell the engine.
#[derive(Debug, Default)]
pub struct ExactUpdate {
    /// The pose to show.
    pub posed: Posed,
    /// A set that has just been made, of whatever pose.
    pub exact: Option<Arc<ExactVoxels>>,
    /// What went wrong or was left out, a sentence each.
    pub warnings: Vec<String>,
}

impl ExactJob {
    /// Once a frame. `posed`: the pose the person asked for.
    pub fn update(
        &mut self,
        ctx: &egui::Context,
        scene: &Arc<Prepared>,
        posed: &Posed,
        looked_at: bool,
    ) -> ExactUpdate {
        let mut update = ExactUpdate { posed: posed.clone(), ..ExactUpdate::default() };
        let same_scene = self.scene.as_ref().is_some_and(|old| Arc::ptr_eq(old, scene));
        if !looked_at || !same_scene {
            let took = if same_scene { self.took } else { Duration::ZERO };
            *self = Self { took, pace: self.pace, ..Self::default() };
            self.scene = Some(Arc::clone(scene));
            if !looked_at {
                return update;
            }
        }
        if self.wanted.as_ref() != Some(posed) {
            (self.wanted, self.wanted_since) = (Some(posed.clone()), Some(Instant::now()));
        }
        self.collect(&mut update);
        self.start(ctx, posed);
        self.choose_pose(&mut update);
        update
    }

    /// Whether a set is being made.
    pub fn fraction(&self) -> Option<f32> {
        self.running.as_ref().map(|running| running.work.fraction())
    }

    /// Whether its thread has not ended yet.
    pub fn is_at_work(&self) -> bool {
        self.running.as_ref().is_some_and(|running| !running.work.has_ended())
    }

    /// The exact set of the pose that is asked for is not there yet, whether its thread has begun or not.
    pub fn is_behind(&self) -> bool {
        self.wanted.is_some() && self.wanted != self.shown
    }

    fn follows(&self) -> bool {
        self.took <= self.pace.blink
    }

    fn collect(&mut self, update: &mut ExactUpdate) {
        let Some(running) = &self.running else { return };
        let outcome = running.work.poll();
        if matches!(outcome, Outcome::Running) {
            let stale = self.wanted.as_ref() != Some(&running.posed);
            if stale && running.started.elapsed() > self.pace.blink {
                self.took = running.started.elapsed();
                self.running = None;
            }
            return;
        }
        let Some(running) = self.running.take() else { return };
        self.took = running.started.elapsed();
        // A failed pose counts as shown: without an exact set, and not tried again.
        self.shown = Some(running.posed);
        match outcome {
            Outcome::Done(Ok(exact)) => {
                update.warnings.clone_from(&exact.warnings);
                update.exact = Some(Arc::new(exact));
            }
            Outcome::Done(Err(ExactError::Cancelled(_))) | Outcome::Running => {}
            Outcome::Done(Err(error)) => update.warnings.push(error.to_string()),
            Outcome::Died => update.warnings.push("the exact voxelization ended unexpectedly".to_owned()),
        }
    }

    fn start(&mut self, ctx: &egui::Context, posed: &Posed) {
        let Some(scene) = &self.scene else { return };
        if self.running.is_some() || self.shown.as_ref() == Some(posed) {
            return;
        }
        let rested = self.wanted_since.map_or(Duration::ZERO, |since| since.elapsed());
        if !self.follows() && rested < REST {
            ctx.request_repaint_after(REST - rested);
            return;
        }
        let (scene, of_job) = (Arc::clone(scene), posed.clone());
        let work = Background::start(ctx, move |progress| {
            scene.exact(&of_job.motion, &scene.hidden(&of_job.visibility, &scene.pose(&of_job.motion)?)?, progress)
        });
        self.running = Some(Running { posed: posed.clone(), started: Instant::now(), work });
    }

    fn choose_pose(&mut self, update: &mut ExactUpdate) {
        let Some(shown) = &self.shown else { return };
        if *shown == update.posed {
            return;
        }
        if self.follows() {
            update.posed = shown.clone();
        } else {
            self.shown = None;
        }
    }
}
