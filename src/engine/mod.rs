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
mod inspect;
mod light;
mod light_views;
mod node_reader;
mod picture;
mod read_voxels;
mod record;
mod report;
mod run;
mod sample;
mod scene_on_gpu;
mod steps;

use std::sync::Arc;
use std::time::Duration;

use crate::data::octree::{PointerLayout, Slot};
use crate::data::pages::SegmentOrder;
use crate::gpu::{BufferUse, Gpu, GpuBuffer, GpuError, GpuTexture, KernelTiming};
use crate::lights::{PosedLight, posed_lights};
use crate::plan::{self, Changes, FramePlan, SceneFacts};
use crate::prepare::{ExactVoxels, FrameMatrices, MotionError, Prepared};
use crate::scene::Pose;
use crate::settings::{ColorBy, Filter, Hidden, Look, Settings, View, VisibilityError};
use crate::stages::fill::number_objects::OBJECT_MASK;
use crate::stages::mesh::MeshScene;
use crate::stages::view::Picture;

pub use built_octree::BuiltOctree;
pub use inspect::{NodeAddress, NodeFacts, StoredNode};
use light::{LightOnGpu, LitBy, ShadowedBy};
use picture::ExactMasks;
pub use read_voxels::WorldVoxels;
pub use report::{AccuracyReport, FilterReport, LevelReport, OctreeReport};
use run::{Comparison, FrameTimings, Running};
use scene_on_gpu::SceneOnGpu;

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EngineError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    #[error("no scene is open")]
    NoScene,
    #[error("{scene} has {objects} objects, and colour by object can tell {OBJECT_MASK} apart; choose another colour")]
    TooManyObjects { scene: String, objects: usize },
}

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
    picture: Option<Picture>,
    mesh: Option<MeshScene>,
    mesh_matrices: Slot,
    mesh_depth: Option<GpuTexture>,
    timings: FrameTimings,
}

/// One request, with its pose folded.
#[derive(Clone, Debug)]
struct Wanted {
    settings: Settings,
    size_px: [u32; 2],
    pose: Arc<Pose>,
    lights: Vec<PosedLight>,
    frame: FrameMatrices,
    hidden: Hidden,
    facts: SceneFacts,
}

impl Wanted {
    fn lit_by(&self) -> LitBy {
        LitBy { lights: self.lights.clone(), lighting: self.settings.lighting.clone() }
    }

    /// Nothing of the scene is in the picture: all of it is hidden, or outside the grid.
    fn shows_nothing(&self) -> bool {
        match self.settings.look.view {
            View::Mesh => self.facts.triangles == 0,
            View::ShadowMap => self.facts.triangles == 0 || self.facts.lights == 0,
            View::Voxels | View::Ghost | View::Slice => self.facts.voxels() == 0,
        }
    }
}

/// What the results on the GPU were made from; `None` where there is none, or it is out of date.
#[derive(Clone, Debug, Default)]
struct Done {
    /// World voxels follow the matrices that `scene` holds.
    moved: bool,
    octree: Option<(Filter, u32)>,
    object_numbers: bool,
    other: Option<(Filter, u32)>,
    compared: Option<Arc<ExactVoxels>>,
    view: Option<(Look, [u32; 2])>,
    /// What the mesh view last drew.
    mesh_frame: Option<(FrameMatrices, Hidden)>,
    exact_masks: Option<Arc<ExactVoxels>>,
    links: Vec<PointerLayout>,
    emission: bool,
    shadows: Option<ShadowedBy>,
    light: Option<LitBy>,
    irradiance: bool,
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

    /// What is wanted now. Cheap: the frame begins with the next [`Self::advance`].
    pub fn request(&mut self, settings: &Settings, size_px: [u32; 2]) -> Result<(), EngineError> {
        let prepared = self.prepared.as_ref().ok_or(EngineError::NoScene)?;
        check_object_numbers(prepared, &settings.look)?;
        let hidden = prepared.hidden(&settings.visibility)?;
        let frame = prepared.fold(&settings.motion, settings.discretization.anchor, &hidden)?;
        let pose = Arc::new(prepared.pose(&settings.motion)?);
        let shown = settings.visibility.shown_nodes(&prepared.scene)?;
        let emits = prepared.brightest_emission > 0.0 && settings.lighting.emission > 0.0;
        let lights = posed_lights(&prepared.scene, &pose, &settings.lighting, &shown, emits);
        let facts = SceneFacts { lights: lights.len() as u32, ..scene_on_gpu::facts(prepared, &frame, &hidden) };
        // A picture has at least one pixel.
        let size_px = size_px.map(|size| size.max(1));
        self.wanted = Some(Wanted { settings: settings.clone(), size_px, pose, lights, frame, hidden, facts });
        if self.running.is_none() {
            self.make_plan();
        }
        Ok(())
    }

    /// Nothing of the scene is in the picture that was requested: all of it is hidden, or outside the grid.
    pub fn shows_nothing(&self) -> bool {
        self.wanted.as_ref().is_some_and(Wanted::shows_nothing)
    }

    /// The octree that is built is of what was requested, which has voxels in the grid.
    fn has_octree(&self) -> bool {
        self.done.octree.is_some() && self.wanted.as_ref().is_some_and(|wanted| wanted.facts.voxels() > 0)
    }

    /// Objects that the requested pose cannot show, a sentence each.
    pub fn left_out(&self) -> Vec<String> {
        let (Some(prepared), Some(wanted)) = (&self.prepared, &self.wanted) else { return Vec::new() };
        let name = |&object: &usize| &prepared.objects[object].object.name;
        let objects = wanted.frame.left_out.iter().map(name);
        objects.map(|name| format!("object \"{name}\" is left out: in this pose its matrix is not finite")).collect()
    }

    fn make_plan(&mut self) {
        let Some(wanted) = &self.wanted else { return };
        self.plan = plan::plan(&wanted.facts, &self.changes(wanted), &wanted.settings);
    }

    fn changes(&self, wanted: &Wanted) -> Changes {
        let discretization = &wanted.settings.discretization;
        let key = (discretization.filter, discretization.dense_level());
        let other = (other_filter(discretization.filter), discretization.dense_level());
        let of_frame = self.scene.as_ref().map(|scene| scene.changes(&wanted.frame)).unwrap_or_default();
        let fresh = |done: &Option<Arc<ExactVoxels>>| match (&self.exact, done) {
            (Some(exact), Some(done)) => !Arc::ptr_eq(exact, done),
            (exact, done) => exact.is_some() != done.is_some(),
        };
        let drawn = self.done.mesh_frame.as_ref();
        let mesh_moved = wanted.settings.look.view == View::Mesh
            && drawn.is_none_or(|(frame, hidden)| *frame != wanted.frame || *hidden != wanted.hidden);
        Changes {
            caches: self.scene.is_none(),
            residents: of_frame.residents,
            rigid_poses: of_frame.rigid_poses || !self.done.moved,
            skinned_poses: of_frame.skinned_poses || !self.done.moved,
            octree: self.done.octree != Some(key),
            other_octree: self.done.other != Some(other),
            exact: fresh(&self.done.compared),
            exact_masks: fresh(&self.done.exact_masks),
            exact_known: self.exact.is_some(),
            view: self.done.view != Some((wanted.settings.look, wanted.size_px)) || mesh_moved,
            object_numbers: !self.done.object_numbers,
            links: self.links_missing(wanted),
            emission: !self.done.emission,
            shadow_maps: self.shadows_changed(wanted),
            lighting: self.done.light.as_ref() != Some(&wanted.lit_by()),
            irradiance: !self.done.irradiance,
        }
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
        self.done.light = None;
        self.done.shadows = None;
        self.done.emission = false;
        self.done.links.clear();
    }

    /// Kernel times of the results that are there: the last build, and the last picture of it.
    pub fn timings(&self) -> Vec<KernelTiming> {
        self.timings.all()
    }

    pub fn memory(&self) -> Vec<BufferUse> {
        self.gpu.memory()
    }
}

/// A leaf stores its object in 16 bits, of which the largest number stands for none.
fn check_object_numbers(prepared: &Prepared, look: &Look) -> Result<(), EngineError> {
    let objects = prepared.objects.len();
    if look.view == View::Voxels && look.color == ColorBy::Object && objects > OBJECT_MASK as usize {
        return Err(EngineError::TooManyObjects { scene: prepared.scene.name.clone(), objects });
    }
    Ok(())
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
