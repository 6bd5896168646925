//! Runs a plan: owns what is on the GPU and turns each frame's rows into submissions short enough
//! that a window on the same queue stays fluid. Window and command line drive this same engine.
//!
//! ```text
//! request(settings) ─► plan ─► steps ─► one Job a step ─► image, reports, timings
//! ```
//!
//! A frame that has begun building is finished before the next request is looked at, so that a
//! playing animation always shows something.

mod built_octree;
mod cones;
mod error;
mod inspect;
mod light;
mod light_views;
mod node_reader;
mod picture;
mod read_irradiance;
mod read_voxels;
mod record;
mod report;
mod run;
mod sample;
mod scene_on_gpu;
mod shadows;
mod steps;
mod surface_steps;
mod surfaces;
mod wanted;

use std::sync::Arc;
use std::time::Duration;

use crate::data::octree::Slot;
use crate::data::pages::SegmentOrder;
use crate::gpu::{BufferUse, Gpu, GpuBuffer, GpuError, GpuTexture, KernelTiming};
use crate::lights;
use crate::plan::{self, FramePlan};
use crate::prepare::{ExactVoxels, Prepared};
use crate::settings::Filter;
use crate::stages::mesh::MeshScene;
use crate::stages::view::Picture;

pub use built_octree::BuiltOctree;
pub use error::EngineError;
pub use inspect::{NodeAddress, NodeFacts, StoredNode};
use light::LightOnGpu;
use picture::ExactMasks;
pub use read_voxels::WorldVoxels;
pub use report::{AccuracyReport, FilterReport, LevelReport, OctreeReport};
use run::{Comparison, FrameTimings, Running};
use scene_on_gpu::SceneOnGpu;
use surface_steps::SurfaceTimings;
use surfaces::SurfacesOnGpu;
use wanted::{Done, Wanted};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineState {
    /// The part of the frame that is done, 0 to 1.
    Working { fraction: f32 },
    /// Everything asked for is there.
    Idle,
}

pub struct Engine {
    gpu: Arc<Gpu>,
    segment_order: SegmentOrder,
    prepared: Option<Arc<Prepared>>,
    exact: Option<Arc<ExactVoxels>>,
    wanted: Option<Wanted>,
    plan: FramePlan,
    done: Done,
    running: Option<Running>,
    scene: Option<SceneOnGpu>,
    shown: BuiltOctree,
    other: BuiltOctree,
    exact_bits: Option<(Arc<ExactVoxels>, GpuBuffer)>,
    comparison_counts: Slot,
    comparison: Comparison,
    exact_masks: ExactMasks,
    light: LightOnGpu,
    surfaces: SurfacesOnGpu,
    picture: Option<Picture>,
    mesh: Option<MeshScene>,
    mesh_matrices: Slot,
    mesh_depth: Option<GpuTexture>,
    timings: FrameTimings,
}

impl Engine {
    pub fn new(gpu: Arc<Gpu>) -> Self {
        Self::with_segment_order(gpu, SegmentOrder::default())
    }

    /// Results do not depend on the order in which segments are taken; tests show that.
    pub fn with_segment_order(gpu: Arc<Gpu>, segment_order: SegmentOrder) -> Self {
        Self {
            exact_masks: ExactMasks::default(),
            light: LightOnGpu::default(),
            surfaces: SurfacesOnGpu::default(),
            picture: None,
            mesh: None,
            mesh_matrices: Slot::default(),
            mesh_depth: None,
            gpu,
            segment_order,
            prepared: None,
            exact: None,
            wanted: None,
            plan: FramePlan::default(),
            done: Done::default(),
            running: None,
            scene: None,
            shown: BuiltOctree::default(),
            other: BuiltOctree::default(),
            exact_bits: None,
            comparison_counts: Slot::default(),
            comparison: Comparison::default(),
            timings: FrameTimings::default(),
        }
    }

    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Another scene, or other caches of it; everything on the GPU is dropped.
    pub fn set_prepared(&mut self, prepared: Option<Arc<Prepared>>) {
        self.running = None;
        self.wanted = None;
        self.done = Done::default();
        self.scene = None;
        self.shown = BuiltOctree::default();
        self.other = BuiltOctree::default();
        self.exact = None;
        self.exact_bits = None;
        self.exact_masks = ExactMasks::default();
        self.light = LightOnGpu::default();
        self.surfaces = SurfacesOnGpu::default();
        self.mesh = None;
        self.comparison = Comparison::default();
        self.timings = FrameTimings::default();
        self.prepared = prepared;
    }

    pub fn prepared(&self) -> Option<&Arc<Prepared>> {
        self.prepared.as_ref()
    }

    /// The exact voxels of the pose that is requested; `None` while they are not known.
    pub fn set_exact(&mut self, exact: Option<Arc<ExactVoxels>>) {
        self.exact = exact;
    }

    /// Nothing of the scene is in the picture that was requested: all of it is hidden, or outside the grid.
    pub fn shows_nothing(&self) -> bool {
        self.wanted.as_ref().is_some_and(Wanted::shows_nothing)
    }

    /// The octree that is built is of what was requested, which has voxels in the grid.
    fn has_octree(&self) -> bool {
        self.done.octree.is_some() && self.wanted.as_ref().is_some_and(|wanted| wanted.facts.voxels() > 0)
    }

    /// Objects that the requested pose cannot show, lights that are nowhere in it, and a shadow map that is not there, a
    /// sentence each.
    pub fn left_out(&self) -> Vec<String> {
        let (Some(prepared), Some(wanted)) = (&self.prepared, &self.wanted) else { return Vec::new() };
        let name = |&object: &usize| &prepared.objects[object].object.name;
        let objects = wanted.frame.left_out.iter().map(name);
        let objects =
            objects.map(|name| format!("object \"{name}\" is left out: in this pose its matrix is not finite"));
        let (scene, settings) = (&prepared.scene, &wanted.settings);
        // A request with nodes that are not there was refused.
        let shown = settings.visibility.shown_nodes(scene).unwrap_or_default();
        let lost = lights::left_out(scene, &wanted.placed.pose, &settings.lighting, &shown);
        objects.chain(lost).chain(wanted.missing_map()).collect()
    }

    fn make_plan(&mut self) {
        let Some(wanted) = &self.wanted else { return };
        self.plan = plan::plan(&wanted.facts, &self.changes(wanted), &wanted.settings);
    }

    pub fn plan(&self) -> &FramePlan {
        &self.plan
    }

    /// Submits one slice of about `budget` of GPU time if the last has finished; never blocks.
    pub fn advance(&mut self, budget: Duration) -> Result<EngineState, EngineError> {
        if self.running.is_none() {
            self.make_plan();
            if self.plan.is_idle() {
                return Ok(EngineState::Idle);
            }
            self.running = self.wanted.clone().map(|wanted| {
                let steps = steps::of_plan(&self.plan, wanted.settings.lighting.bounces);
                Running::new(wanted, self.plan.clone(), steps)
            });
        }
        let outcome = self.run_slice(budget);
        if outcome.is_err() {
            self.running = None;
        }
        outcome
    }

    /// Runs until everything asked for is there.
    pub fn run_to_end(&mut self) -> Result<(), EngineError> {
        while self.advance(Duration::from_millis(200))? != EngineState::Idle {
            self.gpu.wait()?;
        }
        Ok(())
    }

    /// Forgets results so that the next frame makes them again, as [`bench`](crate) needs.
    pub fn invalidate(&mut self) {
        self.done = Done::default();
    }

    /// Forgets light, shadow maps and pointers alone.
    pub fn invalidate_light(&mut self) {
        self.invalidate_surfaces();
        self.done.light = None;
        self.done.shadows = None;
        self.done.emission = false;
        self.done.links.clear();
    }

    /// Forgets the surface image and all that is made from it.
    pub fn invalidate_surfaces(&mut self) {
        self.timings.surfaces = SurfaceTimings::default();
        self.done.surfaces = None;
        self.done.direct = None;
        self.done.diffuse = None;
        self.done.specular = None;
    }

    /// Kernel times of the results that are there: the last build, and the last picture of it.
    pub fn timings(&self) -> Vec<KernelTiming> {
        self.timings.all()
    }

    pub fn memory(&self) -> Vec<BufferUse> {
        self.gpu.memory()
    }
}

fn other_filter(filter: Filter) -> Filter {
    match filter {
        Filter::Nearest => Filter::Split,
        Filter::Split => Filter::Nearest,
    }
}

/// A buffer that a step reads and none before it has made.
fn missing(label: &str) -> GpuError {
    GpuError::Missing { label: label.to_owned() }
}
