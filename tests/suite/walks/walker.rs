//! A walk: an engine that is asked for one thing after the other, and at the end compared with a fresh one.

use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::time::Duration;

use octolume::engine::{Engine, EngineError, EngineState};
use octolume::gpu::Gpu;
use octolume::plan::Asked;
use octolume::prepare::{ExactVoxels, Prepared};
use octolume::progress::Progress;
use octolume::settings::{Settings, View};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

use super::changes::{change, one_of};
use super::difference::difference;
use super::scenes::prepared;
use crate::random;

/// What one engine may hold beside what a request needs: the picture on screen, uniforms of jobs.
const SLACK_BYTES: u64 = 512 << 10;
const SIZES_PX: [[u32; 2]; 3] = [[48, 32], [33, 40], [64, 48]];

#[derive(Clone, Copy, Debug, Default)]
pub struct Walk {
    pub seed: u64,
    pub steps: u32,
    /// After so many steps the walk is compared with a fresh engine, and goes on.
    pub compared_every: u32,
    /// What plans are told instead of the truth.
    pub told: Option<fn(&mut Asked)>,
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Walked {
    pub errors: u64,
    pub frames: u64,
}

/// One device for all walks, which go one after the other: a memory limit is the device's.
fn gpu() -> &'static Arc<Gpu> {
    static GPU: LazyLock<Arc<Gpu>> = LazyLock::new(|| Arc::new(crate::device::open()));
    &GPU
}

struct Walker {
    rng: TestRng,
    engine: Engine,
    prepared: Arc<Prepared>,
    settings: Settings,
    size_px: [u32; 2],
    limit: Option<u64>,
    /// What the frame on its way was asked for.
    in_flight: Settings,
    told: Option<fn(&mut Asked)>,
    walked: Walked,
}

/// The error says how the end differs from that of a fresh engine, or which error was none.
pub fn walk(walk: &Walk) -> Result<Walked, String> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let mut walker = Walker::new(walk);
    let mut outcome = Ok(());
    for step in 1..=walk.steps {
        outcome = outcome.and_then(|()| walker.step());
        if step.is_multiple_of(walk.compared_every) {
            gpu().limit_memory(None);
            outcome = outcome.and_then(|()| walker.arrive());
            gpu().limit_memory(walker.limit);
        }
    }
    gpu().limit_memory(None);
    outcome.map(|()| walker.walked)
}

impl Walker {
    fn new(walk: &Walk) -> Self {
        let mut walker = Self {
            rng: random::rng(walk.seed),
            engine: Engine::new(Arc::clone(gpu())),
            prepared: Arc::clone(&prepared()[0]),
            settings: Settings::default(),
            size_px: SIZES_PX[0],
            limit: None,
            in_flight: Settings::default(),
            told: walk.told,
            walked: Walked::default(),
        };
        // Small shadow maps and few cones show as much, sooner.
        (walker.settings.method.lighting.shadow_map_px, walker.settings.method.lighting.cones) = (512, 1);
        walker.open();
        walker
    }

    /// Once in so many times.
    fn once_in(&mut self, times: u32) -> bool {
        self.rng.random_range(0..times) == 0
    }

    fn open(&mut self) {
        self.engine.set_prepared(Some(Arc::clone(&self.prepared)));
        self.told.into_iter().for_each(|told| self.engine.mistell(told));
    }

    fn step(&mut self) -> Result<(), String> {
        if self.once_in(20) {
            self.prepared = Arc::clone(&prepared()[self.rng.random_range(0..prepared().len())]);
            self.open();
        }
        self.change_memory();
        if self.once_in(4) {
            let share = one_of(&mut self.rng, &[0.0, 0.5, 0.9, 1.0]);
            self.engine.underestimate(share);
        }
        let before = self.settings.clone();
        change(&mut self.settings, &mut self.rng);
        self.discretize();
        if self.once_in(3) {
            self.size_px = one_of(&mut self.rng, &SIZES_PX);
        }
        if self.once_in(4) {
            self.offer_exact();
        }
        if self.engine.request(&self.settings, self.size_px).is_err() {
            // A clip or a node that is not there: nothing has changed.
            self.settings = before;
            self.discretize();
            // What was set before may be refused by another scene too.
            if self.engine.request(&self.settings, self.size_px).is_err() {
                (self.settings.shot.motion.clip, self.settings.shot.visibility) = (None, Default::default());
            }
        }
        self.advance()
    }

    fn discretize(&mut self) {
        let discretization = &mut self.settings.method.discretization;
        (discretization.grid, discretization.mode) = (self.prepared.grid.cells(), self.prepared.mode);
    }

    fn change_memory(&mut self) {
        if self.once_in(6) {
            let more = u64::from(self.rng.random_range(0..4_u32 << 20));
            self.limit = if self.once_in(2) { None } else { Some(gpu().bytes_in_use() + more) };
            gpu().limit_memory(self.limit);
        }
        if self.once_in(6) {
            let kept = one_of(&mut self.rng, &[0, 4 << 20, 64 << 20, octolume::engine::KEPT_BYTES]);
            self.engine.keep_bytes(kept);
        }
    }

    /// Of the pose that is asked for, or of another.
    fn offer_exact(&mut self) {
        let mut settings = self.settings.clone();
        if self.once_in(3) {
            settings.shot.motion.time_secs += 0.1;
        }
        exact(&self.prepared, &settings).into_iter().for_each(|exact| self.engine.offer_exact(exact));
    }

    /// A few slices, so that the next request comes while a frame is on its way.
    fn advance(&mut self) -> Result<(), String> {
        for _ in 0..self.rng.random_range(0..8) {
            let budget = Duration::from_micros(one_of(&mut self.rng, &[0, 300, 30_000]));
            let begun = self.engine.frames_begun();
            let advanced = self.engine.advance(budget);
            if self.engine.frames_begun() > begun {
                self.walked.frames += self.engine.frames_begun() - begun;
                self.in_flight = self.settings.clone();
            }
            match advanced {
                Ok(EngineState::Idle) => return Ok(()),
                Ok(EngineState::Working { .. }) if self.once_in(4) => {}
                Ok(EngineState::Working { .. }) => self.engine.gpu().wait().map_err(|error| error.to_string())?,
                Err(error) => return self.failed(&error),
            }
        }
        Ok(())
    }

    /// Memory is the only thing that may be missing, and only where it is: a fresh engine fails there too.
    fn failed(&mut self, error: &EngineError) -> Result<(), String> {
        self.walked.errors += 1;
        let Some(limit) = self.limit.filter(|_| error.is_out_of_memory()) else {
            return Err(format!("{error}, for {:?}", self.in_flight));
        };
        if self.once_in(2) {
            return Ok(());
        }
        self.engine = Engine::new(Arc::clone(gpu()));
        gpu().limit_memory(Some(limit.saturating_sub(SLACK_BYTES)));
        let fresh = self.fresh(&self.in_flight).and_then(|mut fresh| fresh.run_to_end());
        gpu().limit_memory(self.limit);
        self.open();
        match fresh {
            Err(error) if error.is_out_of_memory() => Ok(()),
            Err(error) => Err(error.to_string()),
            Ok(()) => Err(format!("{error}, but there was enough for {:?}", self.in_flight)),
        }
    }

    /// An engine that was never asked for anything else.
    fn fresh(&self, settings: &Settings) -> Result<Engine, EngineError> {
        let mut fresh = Engine::new(Arc::clone(gpu()));
        fresh.set_prepared(Some(Arc::clone(&self.prepared)));
        exact_where_looked_at(&self.prepared, settings).into_iter().for_each(|exact| fresh.offer_exact(exact));
        fresh.request(settings, self.size_px)?;
        Ok(fresh)
    }

    fn arrive(&mut self) -> Result<(), String> {
        let tell = |error: EngineError| error.to_string();
        let exact = exact_where_looked_at(&self.prepared, &self.settings);
        exact.into_iter().for_each(|exact| self.engine.offer_exact(exact));
        self.engine.request(&self.settings, self.size_px).map_err(tell)?;
        self.engine.run_to_end().map_err(tell)?;
        let mut fresh = self.fresh(&self.settings).map_err(tell)?;
        fresh.run_to_end().map_err(tell)?;
        match difference(&self.engine, &fresh) {
            Some(what) => Err(format!("{what}; for {:?}", self.settings)),
            None => Ok(()),
        }
    }
}

fn exact(prepared: &Prepared, settings: &Settings) -> Option<Arc<ExactVoxels>> {
    let hidden = prepared.hidden(&settings.shot.visibility, &prepared.pose(&settings.shot.motion).ok()?).ok()?;
    Some(Arc::new(prepared.exact(&settings.shot.motion, &hidden, &Progress::default()).ok()?))
}

fn exact_where_looked_at(prepared: &Prepared, settings: &Settings) -> Option<Arc<ExactVoxels>> {
    let is_looked_at = settings.method.look.accuracy || settings.method.look.view == View::Ghost;
    exact(prepared, settings).filter(|_| is_looked_at)
}
