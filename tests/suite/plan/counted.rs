//! What an engine really dispatches and makes, counted against the plan.

use std::collections::BTreeSet;
use std::sync::Arc;

use octolume::engine::Engine;
use octolume::gpu::{Counters, Gpu};
use octolume::plan::{FramePlan, Pass};
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{OrbitCamera, Scene, Trs};
use octolume::settings::{Filter, Settings};

use super::running;
use crate::scenes::{at, cube_scene, skinned_scene, sliding_scene};

/// An engine on a device of its own, so that counts are its alone.
pub struct Counted {
    pub engine: Engine,
    pub settings: Settings,
    before: Counters,
}

impl Counted {
    pub fn new(scene: Scene) -> Self {
        let mut settings = Settings::default();
        settings.method.discretization.grid = 64;
        let prepared = prepared(scene, &settings);
        let gpu = Gpu::headless(&octolume::stages::SHADERS, None).unwrap_or_else(|error| panic!("{error}"));
        let mut engine = Engine::new(Arc::new(gpu));
        engine.set_prepared(Some(Arc::new(prepared)));
        Self { engine, settings, before: Counters::default() }
    }

    /// Runs a frame; the kernels it dispatched must be those of the plan's running rows, and a
    /// frame that runs nothing makes nothing.
    pub fn frame(&mut self) -> (FramePlan, Counters) {
        self.engine.request(&self.settings, [32, 32]).expect("a request");
        let plan = self.engine.plan().clone();
        self.engine.run_to_end().expect("a frame");
        let now = self.engine.gpu().counters();
        let ran: BTreeSet<&str> = now
            .dispatches
            .iter()
            .filter(|(kernel, count)| **count > self.before.dispatches.get(*kernel).copied().unwrap_or(0))
            .map(|(kernel, _)| kernel.as_str())
            .collect();
        let mut planned: BTreeSet<&str> =
            Pass::ALL.into_iter().filter(|&pass| plan.runs(pass)).flat_map(Pass::kernels).copied().collect();
        if self.engine.glossy_tiles() == 0 {
            // Decided tile by tile, on the GPU: none is glossy.
            planned.remove("cones/specular");
        }
        assert_eq!(ran, planned);
        let made = Counters {
            dispatches: now.dispatches.clone(),
            pipelines: now.pipelines - self.before.pipelines,
            buffers: now.buffers - self.before.buffers,
        };
        self.before = now;
        (plan, made)
    }
}

fn prepared(scene: Scene, settings: &Settings) -> Prepared {
    prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn assert_nothing_made(made: &Counters) {
    assert_eq!((made.pipelines, made.buffers), (0, 0));
}

#[test]
fn a_still_scene_dispatches_nothing_after_its_first_frame() {
    let mut counted = Counted::new(cube_scene(Trs::default()));
    let (first, made) = counted.frame();
    assert!(first.runs(Pass::MarkLeaves) && made.pipelines > 0 && made.buffers > 0);
    let (still, made) = counted.frame();
    assert!(still.is_idle());
    assert_nothing_made(&made);
}

#[test]
fn a_moved_camera_dispatches_the_march_alone() {
    let mut counted = Counted::new(cube_scene(Trs::default()));
    counted.frame();
    counted.settings.shot.camera = Some(OrbitCamera::default());
    let (plan, made) = counted.frame();
    assert_eq!(running(&plan), [Pass::MarchVoxels]);
    assert_nothing_made(&made);
}

#[test]
fn rigid_motion_never_makes_a_skinning_pipeline_or_joint_buffer() {
    let mut counted = Counted::new(sliding_scene());
    counted.frame();
    counted.settings.shot.motion.time_secs = 0.5;
    let (plan, made) = counted.frame();
    assert!(plan.runs(Pass::TransformRigid));
    assert_eq!(made.pipelines, 0);
    assert!(!counted.before.dispatches.contains_key("transform/skinned"));
    assert!(counted.engine.memory().iter().all(|buffer| buffer.label != "cache joints"));
}

#[test]
fn a_skin_is_moved_by_the_skinning_kernel_alone() {
    let scene = skinned_scene(
        [0, 1, 0, 0],
        [0.5, 0.5, 0.0, 0.0],
        &[Trs::default(), at(0.5, 0.0, 0.0)],
        &[glam::DMat4::IDENTITY; 2],
    );
    let mut counted = Counted::new(scene);
    let (plan, _) = counted.frame();
    assert!(plan.runs(Pass::TransformSkinned) && !plan.runs(Pass::TransformRigid));
    assert!(counted.engine.memory().iter().any(|buffer| buffer.label == "cache joints"));
}

#[test]
fn the_nearest_filter_gathers_without_splitting() {
    let mut counted = Counted::new(cube_scene(Trs::default()));
    counted.settings.method.discretization.filter = Filter::Nearest;
    let (plan, _) = counted.frame();
    assert!(plan.runs(Pass::GatherNearest) && !plan.runs(Pass::GatherSplit));
    let report = counted.engine.octree_report().expect("an octree");
    let voxels = report.voxels * u64::from(octolume::data::octree::FULL_WEIGHT);
    assert_eq!(report.kept_weight + report.clipped_weight, voxels);
}

#[test]
fn an_empty_scene_touches_no_gpu() {
    let mut counted = Counted::new(Scene::default());
    let (plan, made) = counted.frame();
    assert!(plan.is_idle());
    assert_nothing_made(&made);
    assert!(counted.engine.image().is_none());
}

#[test]
fn a_frame_built_anew_equals_the_one_that_reused() {
    let mut reusing = Counted::new(sliding_scene());
    for time_secs in [0.0, 0.3, 0.7] {
        reusing.settings.shot.motion.time_secs = time_secs;
        reusing.frame();
    }
    let mut fresh = Counted::new(sliding_scene());
    fresh.settings.shot.motion.time_secs = 0.7;
    fresh.frame();
    let read = |counted: &Counted| counted.engine.read_voxels().expect("voxels");
    assert_eq!(read(&reusing), read(&fresh));
}

#[test]
fn two_filters_share_what_is_moved_and_switching_back_rebuilds_nothing() {
    let mut counted = Counted::new(sliding_scene());
    let filters = [Filter::Nearest, Filter::Split, Filter::Nearest, Filter::Split];
    let plans = filters.map(|filter| {
        counted.settings.method.discretization.filter = filter;
        counted.frame().0
    });
    assert!(plans[0].runs(Pass::TransformRigid) && !plans[1].runs(Pass::TransformRigid));
    assert!(plans[1].runs(Pass::GatherSplit));
    assert!(plans[2].is_idle() && plans[3].is_idle(), "the octrees and their pictures are there");
    counted.settings.method.look.accuracy = true;
    assert!(counted.frame().0.is_idle(), "and nothing is compared yet");
    counted.settings.shot.motion.time_secs = 0.5;
    let before = counted.before.dispatches.clone();
    counted.frame();
    let times = |kernel: &str| counted.before.dispatches[kernel] - before[kernel];
    assert_eq!(
        [times("transform/rigid"), times("build/mark"), times("fill/gather"), times("view/march")],
        [1, 2, 2, 1]
    );
}

#[test]
fn no_more_is_kept_than_is_stated() {
    let mut counted = Counted::new(sliding_scene());
    let bytes = |counted: &Counted| counted.engine.gpu().bytes_in_use();
    counted.frame();
    let one = bytes(&counted);
    for frame in 1..20_u32 {
        counted.settings.shot.motion.time_secs = f64::from(frame) * 0.05;
        counted.frame();
    }
    // A second picture, so that the one on screen stays while the next is drawn; buffers grow with the octree.
    assert!(bytes(&counted) < 2 * one, "a playing clip keeps {} bytes, one frame {one}", bytes(&counted));
    counted.settings.method.discretization.filter = Filter::Nearest;
    counted.frame();
    let both = bytes(&counted);
    counted.engine.keep_bytes(0);
    counted.settings.shot.camera = Some(OrbitCamera::default());
    counted.frame();
    assert!(bytes(&counted) < both, "what is not shown goes");
}
