//! A frame on its way: one slice of a step at a time, and what holds when a step is done.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::light::LitBy;
use super::steps::{Step, Stored, Which};
use super::surface_steps::SurfaceTimings;
use super::{Engine, EngineError, EngineState, Wanted, missing, other_filter};
use crate::data::light::LIGHT_BYTES;
use crate::gpu::{GpuBuffer, Job, JobState, KernelTiming, PendingRead, Recorder};
use crate::plan::FramePlan;
use crate::settings::View;
use crate::stages::compare::compare_sets;

/// A frame on its way.
pub struct Running {
    wanted: Wanted,
    plan: FramePlan,
    steps: VecDeque<Step>,
    total: usize,
    work: Option<Work>,
}

pub(super) enum Work {
    Job(Box<Job>),
    Read(PendingRead),
}

impl Work {
    pub fn job(recorder: Recorder) -> Self {
        Self::Job(Box::new(Job::new(recorder)))
    }
}

impl Running {
    pub fn new(wanted: Wanted, plan: FramePlan, steps: VecDeque<Step>) -> Self {
        let total = steps.len();
        Self { wanted, plan, steps, total, work: None }
    }

    fn state(&self, part_of_step: f32) -> EngineState {
        let left = self.steps.len() as f32 - part_of_step;
        EngineState::Working { fraction: 1.0 - left / self.total.max(1) as f32 }
    }
}

/// Holes, spill and cells in both, of the shown octree and the other.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    pub shown: Option<[u64; 3]>,
    pub other: Option<[u64; 3]>,
}

/// Kernel times of the parts of a frame, each kept until it runs again.
#[derive(Clone, Debug, Default)]
pub struct FrameTimings {
    pub moved: Vec<KernelTiming>,
    build: Vec<KernelTiming>,
    numbered: Vec<KernelTiming>,
    linked: Vec<KernelTiming>,
    emission: Vec<KernelTiming>,
    shadows: Vec<KernelTiming>,
    lit: Vec<KernelTiming>,
    irradiance: Vec<KernelTiming>,
    pub surfaces: SurfaceTimings,
    picture: Vec<KernelTiming>,
    compared: Vec<KernelTiming>,
}

impl FrameTimings {
    pub fn all(&self) -> Vec<KernelTiming> {
        let built = [&self.moved, &self.build, &self.numbered, &self.linked];
        let lit = [&self.emission, &self.shadows, &self.lit, &self.irradiance];
        let shown = [&self.picture, &self.compared];
        let before = built.into_iter().chain(lit).flatten();
        before.chain(self.surfaces.all()).chain(shown.into_iter().flatten()).cloned().collect()
    }
}

impl Engine {
    /// One slice of the running frame.
    pub(super) fn run_slice(&mut self, budget: Duration) -> Result<EngineState, EngineError> {
        let Some(mut running) = self.running.take() else { return Ok(EngineState::Idle) };
        let Some(&step) = running.steps.front() else { return Ok(EngineState::Idle) };
        if step == Step::UploadMesh && !self.upload_mesh(&running.wanted, budget)? {
            let state = running.state(0.0);
            self.running = Some(running);
            return Ok(state);
        }
        let work = match running.work.take() {
            Some(work) => Some(work),
            None => self.start(step, &running)?,
        };
        let mut took = Vec::new();
        let part = match work {
            None => None,
            Some(Work::Job(mut job)) => match job.advance(&self.gpu, budget)? {
                JobState::Done => {
                    took = job.take_timings();
                    None
                }
                JobState::Running { submitted } => {
                    running.work = Some(Work::Job(job));
                    Some(submitted)
                }
            },
            Some(Work::Read(read)) => match read.take(&self.gpu)? {
                Some(bytes) => {
                    self.received(step, &bytes);
                    None
                }
                None => {
                    running.work = Some(Work::Read(read));
                    Some(0.0)
                }
            },
        };
        if part.is_none() {
            running.steps.pop_front();
            self.finished(step, &running.wanted, took);
        }
        let state = running.state(part.unwrap_or(0.0));
        if !running.steps.is_empty() {
            self.running = Some(running);
        }
        Ok(state)
    }

    fn start(&mut self, step: Step, running: &Running) -> Result<Option<Work>, EngineError> {
        let job = |recorder| Ok(Some(Work::job(recorder)));
        match step {
            Step::UploadCaches => {
                self.upload_caches()?;
                Ok(None)
            }
            // Uploaded slice by slice before it gets here.
            Step::UploadMesh => Ok(None),
            Step::Move => job(self.record_move(&running.wanted, &running.plan)?),
            Step::Masks(which) => job(self.record_masks(which, &running.wanted)?),
            Step::Nodes(which) => {
                let voxels = self.voxels()?;
                let gpu = Arc::clone(&self.gpu);
                job(self.octree(which).record_nodes(&gpu, &voxels)?)
            }
            Step::NumberObjects => {
                let voxels = self.voxels()?;
                job(self.shown.record_object_numbers(&self.gpu, &voxels)?)
            }
            Step::LinkNodes => job(self.record_links(&running.wanted)?),
            Step::Emission => job(self.record_emission()?),
            Step::Shadows => job(self.record_shadows(&running.wanted)?),
            Step::Illuminate => job(self.record_illuminate(&running.wanted)?),
            Step::Inject { bounced } => job(self.record_inject(&running.wanted, bounced)?),
            Step::GatherSky => job(self.record_sky(&running.wanted)?),
            Step::GatherBounce => job(self.record_bounce(&running.wanted)?),
            Step::Irradiance => job(self.record_irradiance(&running.wanted)?),
            Step::LightRoot(stored) => {
                let light = self.light.stored(stored).made("light")?;
                Ok(Some(self.read(&light, LIGHT_BYTES)?))
            }
            Step::Surface(step) => Ok(Some(self.start_surface_step(step, &running.wanted)?)),
            Step::ReduceExact => job(self.record_exact_masks()?),
            Step::Picture => job(self.record_picture(&running.wanted)?),
            Step::Compare(which) => job(self.record_comparison(which)?),
            Step::Sizes(which) => {
                let octree = self.octree(which);
                let (buffer, bytes) = octree.sizes().ok_or_else(|| missing("octree sizes"))?;
                let buffer = buffer.clone();
                Ok(Some(self.read(&buffer, bytes)?))
            }
            Step::Root(which) => {
                let nodes = self.octree(which).buffers.payload.nodes.made("nodes")?;
                Ok(Some(self.read(&nodes, 8)?))
            }
            Step::Counts(_) => {
                let counts = self.counts_buffer()?;
                Ok(Some(self.read(&counts, 4 * compare_sets::COUNT_WORDS)?))
            }
        }
    }

    pub(super) fn read(&self, buffer: &GpuBuffer, bytes: u64) -> Result<Work, EngineError> {
        Ok(Work::Read(self.gpu.start_read(buffer, 0..bytes)?))
    }

    /// Bytes a step asked for have come.
    fn received(&mut self, step: Step, bytes: &[u8]) {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(bytes);
        match step {
            Step::Sizes(which) => self.octree(which).set_sizes(&words),
            Step::Root(which) => self.octree(which).occupancy = u64::from(words[0]) | u64::from(words[1]) << 32,
            Step::LightRoot(stored) => self.light.set_root(stored, bytemuck::pod_read_unaligned(bytes)),
            Step::Surface(step) => self.surface_step_received(step, bytes),
            Step::Counts(Which::Shown) => self.comparison.shown = Some([0, 1, 2].map(|i| u64::from(words[i]))),
            Step::Counts(Which::Other) => self.comparison.other = Some([0, 1, 2].map(|i| u64::from(words[i]))),
            _ => {}
        }
    }

    /// Notes what now holds.
    fn finished(&mut self, step: Step, wanted: &Wanted, took: Vec<KernelTiming>) {
        let discretization = &wanted.settings.discretization;
        match step {
            Step::UploadCaches | Step::UploadMesh => {}
            Step::Move => {
                self.done.moved = true;
                self.timings.moved = took;
            }
            Step::Masks(which) => self.octree(which).timings = took,
            Step::Nodes(which) => self.octree(which).timings.extend(took),
            Step::Root(Which::Shown) => {
                self.done.octree = Some((discretization.filter, discretization.dense_level()));
                self.timings.build = self.shown.timings.clone();
            }
            Step::Root(Which::Other) => {
                self.done.other = Some((other_filter(discretization.filter), discretization.dense_level()));
            }
            Step::NumberObjects => {
                self.done.object_numbers = true;
                self.timings.numbered = took;
            }
            Step::LinkNodes => {
                self.done.links = self.wanted_pointers(wanted);
                self.timings.linked = took;
            }
            Step::Emission => {
                self.done.emission = true;
                self.timings.emission = took;
            }
            Step::Shadows => {
                self.done.shadows = self.shadowed_by(wanted);
                self.timings.shadows = took;
            }
            Step::Illuminate => self.timings.lit = took,
            Step::Inject { .. } | Step::GatherSky | Step::GatherBounce => self.timings.lit.extend(took),
            Step::LightRoot(Stored::Radiance) => {
                self.done.light = Some(LitBy::new(wanted));
                self.done.irradiance = false;
                self.done.diffuse = None;
                self.done.specular = None;
            }
            Step::Irradiance => self.timings.irradiance = took,
            Step::LightRoot(Stored::Irradiance) => self.done.irradiance = true,
            Step::Surface(step) => self.surface_step_finished(step, wanted, took),
            Step::ReduceExact => self.done.exact_masks = self.exact.clone(),
            Step::Picture => self.picture_finished(wanted, took),
            Step::Compare(Which::Shown) => self.timings.compared = took,
            Step::Compare(Which::Other) => self.timings.compared.extend(took),
            Step::Counts(Which::Other) => self.done.compared = self.exact.clone(),
            Step::Sizes(_) | Step::Counts(Which::Shown) => {}
        }
    }

    fn picture_finished(&mut self, wanted: &Wanted, took: Vec<KernelTiming>) {
        self.timings.picture = took;
        self.done.view = Some((wanted.settings.look, wanted.size_px));
        let is_mesh = wanted.settings.look.view == View::Mesh;
        self.done.mesh = is_mesh.then(|| wanted.placed.clone());
    }
}
