//! The plan, rule by rule without a GPU; then what the engine really did, counted against it.

use std::collections::BTreeSet;
use std::sync::Arc;

use octolume::engine::Engine;
use octolume::gpu::{Counters, Gpu};
use octolume::plan::{Changes, FramePlan, Pass, SceneFacts, State, plan};
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{OrbitCamera, Scene, Trs};
use octolume::settings::{ColorBy, Filter, Settings, View};
use proptest::prelude::*;

use crate::scenes::{at, cube_scene, skinned_scene, sliding_scene};

pub const RIGID: SceneFacts = SceneFacts {
    rigid_voxels: 100,
    skinned_voxels: 0,
    triangles: 12,
    lights: 0,
    emissive_voxels: 0,
    glossy: false,
    picture_px: [64, 48],
};
const SKINNED: SceneFacts = SceneFacts { rigid_voxels: 0, skinned_voxels: 100, ..RIGID };
pub const FIRST: Changes = Changes {
    caches: true,
    residents: true,
    rigid_poses: true,
    skinned_poses: true,
    octree: true,
    other_octree: true,
    exact: false,
    exact_masks: false,
    exact_known: false,
    view: true,
    object_numbers: true,
    links: true,
    emission: true,
    shadow_maps: true,
    lighting: true,
    irradiance: true,
    surfaces: true,
    direct: true,
    diffuse: true,
    specular: true,
};
/// Nothing changed since a frame that had no object numbers, no second octree and no light.
pub const STILL: Changes = Changes {
    caches: false,
    residents: false,
    rigid_poses: false,
    skinned_poses: false,
    octree: false,
    other_octree: true,
    exact: false,
    exact_masks: false,
    exact_known: false,
    view: false,
    object_numbers: true,
    links: true,
    emission: true,
    shadow_maps: true,
    lighting: true,
    irradiance: true,
    surfaces: true,
    direct: true,
    diffuse: true,
    specular: true,
};

const BUILD: [Pass; 7] = [
    Pass::MarkLeaves,
    Pass::ReduceMasks,
    Pass::ScanBlocks,
    Pass::EmitNodes,
    Pass::SortVoxels,
    Pass::GatherSplit,
    Pass::AverageNodes,
];

pub fn running(plan: &FramePlan) -> Vec<Pass> {
    Pass::ALL.into_iter().filter(|&pass| plan.runs(pass)).collect()
}

pub fn reason(plan: &FramePlan, pass: Pass) -> (State, &'static str) {
    let row = plan.rows.iter().find(|row| row.pass == pass).expect("every pass has a row");
    (row.state, row.reason)
}

fn with(passes: &[Pass]) -> Vec<Pass> {
    Pass::ALL.into_iter().filter(|pass| passes.contains(pass)).collect()
}

#[test]
fn every_pass_has_one_row_with_a_reason() {
    let plan = plan(&RIGID, &FIRST, &Settings::default());
    assert_eq!(plan.rows.iter().map(|row| row.pass).collect::<Vec<_>>(), Pass::ALL);
    assert!(plan.rows.iter().all(|row| !row.reason.is_empty()));
}

#[test]
fn the_first_frame_runs_what_the_scene_has() {
    let rigid = plan(&RIGID, &FIRST, &Settings::default());
    let expected =
        [&[Pass::UploadCaches, Pass::ObjectIo, Pass::TransformRigid, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&rigid), with(&expected));
    assert_eq!(reason(&rigid, Pass::TransformSkinned), (State::Skip, "no skin in the grid"));
    let skinned = plan(&SKINNED, &FIRST, &Settings::default());
    assert!(skinned.runs(Pass::TransformSkinned) && !skinned.runs(Pass::TransformRigid));
}

#[test]
fn nothing_changed_runs_nothing() {
    for facts in [RIGID, SKINNED, SceneFacts::default()] {
        assert!(plan(&facts, &STILL, &Settings::default()).is_idle());
    }
}

#[test]
fn a_moved_camera_runs_the_view_alone() {
    let changed = Changes { view: true, ..STILL };
    assert_eq!(running(&plan(&RIGID, &changed, &Settings::default())), [Pass::MarchVoxels]);
}

#[test]
fn a_pose_rebuilds_without_new_caches() {
    let changed = Changes { skinned_poses: true, ..STILL };
    let expected = [&[Pass::TransformSkinned, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&plan(&SKINNED, &changed, &Settings::default())), with(&expected));
}

#[test]
fn another_filter_moves_nothing() {
    let mut settings = Settings::default();
    settings.discretization.filter = Filter::Nearest;
    let plan = plan(&RIGID, &Changes { octree: true, ..STILL }, &settings);
    assert_eq!(reason(&plan, Pass::TransformRigid).0, State::Reuse);
    assert_eq!(reason(&plan, Pass::GatherSplit), (State::Skip, "the filter is nearest"));
    assert!(plan.runs(Pass::GatherNearest) && plan.runs(Pass::MarkLeaves));
}

#[test]
fn an_empty_grid_runs_nothing() {
    let plan = plan(&SceneFacts::default(), &FIRST, &Settings::default());
    assert!(plan.is_idle());
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Skip, "no voxels in the grid"));
}

#[test]
fn the_mesh_view_builds_no_octree() {
    let mut settings = Settings::default();
    settings.look.view = View::Mesh;
    assert_eq!(running(&plan(&RIGID, &FIRST, &settings)), [Pass::DrawMesh]);
    settings.look.accuracy = true;
    assert!(plan(&RIGID, &FIRST, &settings).runs(Pass::GatherSplit));
}

#[test]
fn objects_are_numbered_only_when_looked_at() {
    let mut settings = Settings::default();
    assert_eq!(reason(&plan(&RIGID, &FIRST, &settings), Pass::NumberObjects).0, State::Skip);
    settings.look.color = ColorBy::Object;
    assert_eq!(
        running(&plan(&RIGID, &Changes { view: true, ..STILL }, &settings)),
        [Pass::NumberObjects, Pass::MarchVoxels]
    );
}

#[test]
fn accuracy_builds_the_other_filter_and_compares_once_the_exact_set_is_known() {
    let mut settings = Settings::default();
    settings.look.accuracy = true;
    assert_eq!(running(&plan(&RIGID, &STILL, &settings)), [Pass::BuildOther]);
    let known = Changes { exact: true, exact_known: true, other_octree: false, ..STILL };
    assert_eq!(running(&plan(&RIGID, &known, &settings)), [Pass::CompareExact]);
}

#[test]
fn the_ghost_waits_for_the_exact_set() {
    let mut settings = Settings::default();
    settings.look.view = View::Ghost;
    assert!(plan(&RIGID, &STILL, &settings).is_idle());
    let known = Changes { exact: true, exact_masks: true, exact_known: true, ..STILL };
    assert_eq!(running(&plan(&RIGID, &known, &settings)), [Pass::ReduceExact, Pass::MarchGhost]);
}

const VIEWS: [View; 6] = [View::Voxels, View::Mesh, View::Ghost, View::Slice, View::ShadowMap, View::Surfaces];
/// The passes that draw the picture.
const PICTURES: [Pass; 7] = [
    Pass::ShowSurfaces,
    Pass::MarchVoxels,
    Pass::MarchLight,
    Pass::SliceOctree,
    Pass::ShowShadowMap,
    Pass::DrawMesh,
    Pass::MarchGhost,
];

proptest! {
    /// What runs is never skipped by another rule: no view without its octree, no gather twice.
    #[test]
    fn plans_are_consistent(bits in 0_u32..1 << 20, view in 0_usize..6, accuracy: bool, rigid in 0_u64..2, skinned in 0_u64..2) {
        let bit = |index: u32| bits >> index & 1 == 1;
        let changed = Changes {
            caches: bit(0), residents: bit(1), rigid_poses: bit(2), skinned_poses: bit(3), octree: bit(4),
            other_octree: bit(5), exact: bit(6), exact_masks: bit(7), exact_known: bit(8), view: bit(9),
            object_numbers: bit(10), links: bit(11), emission: bit(12), shadow_maps: bit(13), lighting: bit(14),
            irradiance: bit(15), surfaces: bit(16), direct: bit(17), diffuse: bit(18), specular: bit(19),
        };
        let mut settings = Settings::default();
        settings.look.view = VIEWS[view];
        settings.look.accuracy = accuracy;
        let plan = plan(&SceneFacts { rigid_voxels: rigid, skinned_voxels: skinned, ..RIGID }, &changed, &settings);
        let runs = |pass| plan.runs(pass);
        prop_assert!(PICTURES.into_iter().filter(|&pass| runs(pass)).count() <= 1);
        prop_assert!(!(runs(Pass::GatherNearest) && runs(Pass::GatherSplit)));
        prop_assert_eq!(runs(Pass::MarkLeaves), runs(Pass::AverageNodes));
        prop_assert!(!(runs(Pass::TransformRigid) || runs(Pass::TransformSkinned)) || runs(Pass::MarkLeaves));
    }
}

/// An engine on a device of its own, so that counts are its alone.
pub struct Counted {
    pub engine: Engine,
    pub settings: Settings,
    before: Counters,
}

impl Counted {
    pub fn new(scene: Scene) -> Self {
        let mut settings = Settings::default();
        settings.discretization.grid = 64;
        let prepared = prepared(scene, &settings);
        let gpu = Gpu::headless(None).unwrap_or_else(|error| panic!("{error}"));
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
    prepare(Arc::new(scene), &settings.discretization, None, &Progress::default())
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
    counted.settings.look.camera = Some(OrbitCamera::default());
    let (plan, made) = counted.frame();
    assert_eq!(running(&plan), [Pass::MarchVoxels]);
    assert_nothing_made(&made);
}

#[test]
fn rigid_motion_never_makes_a_skinning_pipeline_or_joint_buffer() {
    let mut counted = Counted::new(sliding_scene());
    counted.frame();
    counted.settings.motion.time_secs = 0.5;
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
    counted.settings.discretization.filter = Filter::Nearest;
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
        reusing.settings.motion.time_secs = time_secs;
        reusing.frame();
    }
    let mut fresh = Counted::new(sliding_scene());
    fresh.settings.motion.time_secs = 0.7;
    fresh.frame();
    let read = |counted: &Counted| counted.engine.read_voxels().expect("voxels");
    assert_eq!(read(&reusing), read(&fresh));
}
