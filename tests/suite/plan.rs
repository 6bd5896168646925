//! The plan, rule by rule without a GPU; then what the engine really did, counted against it.

use std::collections::BTreeSet;
use std::sync::Arc;

use octolume::digest::Digest;
use octolume::engine::Engine;
use octolume::gpu::{Counters, Gpu};
use octolume::plan::{Asked, Contents, FramePlan, Held, Part, Pass, SceneFacts, State, WantedFor, plan};
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{OrbitCamera, Scene, Trs};
use octolume::settings::{ColorBy, Filter, Settings, SliceValue, View};
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

/// The plan of a first frame.
pub fn first(scene: &SceneFacts, settings: &Settings) -> FramePlan {
    plan(&[Asked::new(*scene, settings.clone())], &Held::default())
}

/// The plan of the frame behind one of `before`.
pub fn after(before: &Asked, now: &Asked) -> FramePlan {
    let mut held = Held::default();
    held.hold_all(&plan(std::slice::from_ref(before), &held));
    plan(std::slice::from_ref(now), &held)
}

/// The plan of a frame whose contents differ as told from the frame before.
pub fn changed(scene: &SceneFacts, settings: &Settings, change: impl FnOnce(&mut Asked)) -> FramePlan {
    let before = Asked::new(*scene, settings.clone());
    let mut now = before.clone();
    change(&mut now);
    after(&before, &now)
}

/// Another content than the one that every scene has at first.
pub fn other() -> Digest {
    Digest::of(&1)
}

const BUILD: [Pass; 8] = [
    Pass::MarkLeaves,
    Pass::ReduceMasks,
    Pass::ScanBlocks,
    Pass::CountNodes,
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

/// Reports, the exposure and the node under the cursor are read from parts that the picture itself no longer needs.
#[test]
fn what_is_told_of_a_frame_is_made_again_where_it_was_dropped() {
    let mut slice = Settings::default();
    (slice.method.look.view, slice.method.look.slice.value) = (View::Slice, SliceValue::Radiance);
    let mut surfaces = Settings::default();
    surfaces.method.look.view = View::Surfaces;
    let voxels = [Part::Masks, Part::Topology, Part::Payload];
    let lit = [Part::ComposedLight, Part::Exposure, Part::GlossyTiles];
    let scene = SceneFacts { lights: 1, glossy: true, ..RIGID };
    for (settings, told) in [(&slice, [&voxels[..], &[Part::Light]].concat()), (&surfaces, [voxels, lit].concat())] {
        let asked = [Asked::new(scene, settings.clone())];
        let all = plan(&asked, &Held::default());
        for part in told {
            let mut held = Held::default();
            let kept = all.to_run().iter().filter(|planned| planned.part != part);
            kept.for_each(|planned| held.hold(planned.part, planned.key.clone()));
            let made: Vec<Part> = plan(&asked, &held).to_run().iter().map(|planned| planned.part).collect();
            assert_eq!(made, [part], "{:?}", settings.method.look.view);
        }
    }
}

#[test]
fn every_pass_has_one_row_with_a_reason() {
    let plan = first(&RIGID, &Settings::default());
    assert_eq!(plan.rows.iter().map(|row| row.pass).collect::<Vec<_>>(), Pass::ALL);
    assert!(plan.rows.iter().all(|row| !row.reason.is_empty()));
}

#[test]
fn passes_and_parts_are_numbered_as_they_are_listed_and_every_part_has_a_pass() {
    assert!(Pass::ALL.into_iter().enumerate().all(|(number, pass)| pass as usize == number));
    assert!(Part::ALL.into_iter().enumerate().all(|(number, part)| part as usize == number));
    let made = |part: &Part| Pass::ALL.into_iter().any(|pass| pass.parts().contains(part));
    assert!(Part::ALL.iter().all(made));
}

#[test]
fn the_first_frame_runs_what_the_scene_has() {
    let rigid = first(&RIGID, &Settings::default());
    let expected =
        [&[Pass::UploadCaches, Pass::ObjectIo, Pass::TransformRigid, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&rigid), with(&expected));
    assert_eq!(reason(&rigid, Pass::TransformSkinned), (State::Skip, "no skin in the grid"));
    assert_eq!(reason(&rigid, Pass::MarkLeaves), (State::Run, "made for the first time"));
    let skinned = first(&SKINNED, &Settings::default());
    assert!(skinned.runs(Pass::TransformSkinned) && !skinned.runs(Pass::TransformRigid));
}

#[test]
fn nothing_changed_runs_nothing() {
    for facts in [RIGID, SKINNED, SceneFacts::default()] {
        assert!(changed(&facts, &Settings::default(), |_| {}).is_idle());
    }
}

#[test]
fn a_moved_camera_runs_the_view_alone() {
    let plan = changed(&RIGID, &Settings::default(), |asked| asked.contents.camera = other());
    assert_eq!(running(&plan), [Pass::MarchVoxels]);
    assert_eq!(reason(&plan, Pass::MarchVoxels), (State::Run, "the camera moved"));
    assert_eq!(reason(&plan, Pass::TransformRigid), (State::Reuse, "no rigid object moved"));
}

#[test]
fn a_pose_rebuilds_without_new_caches_and_every_row_names_what_differs() {
    let plan = changed(&SKINNED, &Settings::default(), |asked| asked.contents.skinned = other());
    let expected = [&[Pass::TransformSkinned, Pass::MarchVoxels], &BUILD[..]].concat();
    assert_eq!(running(&plan), with(&expected));
    for pass in expected {
        assert_eq!(reason(&plan, pass), (State::Run, "skinned motion"), "{pass:?}");
    }
}

#[test]
fn another_filter_moves_nothing() {
    let nearest = |asked: &mut Asked| asked.settings.method.discretization.filter = Filter::Nearest;
    let plan = changed(&RIGID, &Settings::default(), nearest);
    assert_eq!(reason(&plan, Pass::TransformRigid).0, State::Reuse);
    assert_eq!(reason(&plan, Pass::GatherSplit), (State::Skip, "the filter is nearest"));
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Run, "another filter"));
    assert!(plan.runs(Pass::GatherNearest));
}

#[test]
fn an_empty_grid_runs_nothing() {
    let plan = first(&SceneFacts::default(), &Settings::default());
    assert!(plan.is_idle());
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Skip, "no voxels in the grid"));
}

#[test]
fn the_mesh_view_builds_no_octree() {
    let mut settings = Settings::default();
    settings.method.look.view = View::Mesh;
    assert_eq!(running(&first(&RIGID, &settings)), [Pass::DrawMesh]);
    settings.method.look.accuracy = true;
    assert!(first(&RIGID, &settings).runs(Pass::GatherSplit));
}

#[test]
fn objects_are_numbered_only_when_looked_at() {
    let settings = Settings::default();
    assert_eq!(reason(&first(&RIGID, &settings), Pass::NumberObjects).0, State::Skip);
    let plan = changed(&RIGID, &settings, |asked| asked.settings.method.look.color = ColorBy::Object);
    assert_eq!(running(&plan), [Pass::NumberObjects, Pass::MarchVoxels]);
}

/// The two methods of a request that measures both filters.
fn measured(exact: Option<Digest>) -> [Asked; 2] {
    let mut shown = Asked::new(RIGID, Settings::default());
    shown.settings.method.look.accuracy = true;
    shown.contents.exact = exact;
    let mut other = Asked { wanted_for: WantedFor::Comparison, ..shown.clone() };
    other.settings.method.discretization.filter = Filter::Nearest;
    [shown, other]
}

#[test]
fn accuracy_builds_the_other_filter_and_compares_once_the_exact_set_is_known() {
    let mut held = Held::default();
    held.hold_all(&plan(&[Asked::new(RIGID, Settings::default())], &held));
    let built = plan(&measured(None), &held);
    let nearest = BUILD.map(|pass| if pass == Pass::GatherSplit { Pass::GatherNearest } else { pass });
    assert_eq!(running(&built), with(&nearest), "of the other method alone; nothing is moved or drawn");
    assert!(built.rows.iter().all(|row| row.state != State::Run || row.method == 1));
    held.hold_all(&built);
    assert_eq!(running(&plan(&measured(Some(other())), &held)), [Pass::UploadExact, Pass::CompareExact]);
}

#[test]
fn what_two_methods_share_is_made_once() {
    let plan = plan(&measured(None), &Held::default());
    let count = |part: Part| plan.to_run().iter().filter(|planned| planned.part == part).count();
    assert_eq!([Part::Caches, Part::Pages, Part::RigidVoxels].map(count), [1; 3]);
    assert_eq!([Part::Masks, Part::Topology, Part::Payload].map(count), [2; 3]);
    assert_eq!(count(Part::Picture), 1);
}

#[test]
fn the_ghost_waits_for_the_exact_set() {
    let mut settings = Settings::default();
    let mut before = Asked::new(RIGID, settings.clone());
    settings.method.look.view = View::Ghost;
    let mut ghost = Asked::new(RIGID, settings);
    assert!(after(&before, &ghost).is_idle());
    ghost.contents.exact = Some(other());
    assert_eq!(running(&after(&before, &ghost)), [Pass::UploadExact, Pass::ReduceExact, Pass::MarchGhost]);
    before = ghost.clone();
    ghost.contents.rigid = other();
    ghost.contents.exact = None;
    let moved = after(&before, &ghost);
    assert!(moved.runs(Pass::MarkLeaves) && !moved.runs(Pass::MarchGhost), "the ghost of another pose is no ghost");
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
    /// What runs is never skipped by another rule: no view without its octree, no gather twice. What runs is made from
    /// what is held or runs before it.
    #[test]
    fn plans_are_consistent(
        bits in 0_u32..1 << 9,
        view in 0_usize..6,
        before in 0_usize..6,
        accuracy: bool,
        rigid in 0_u64..2,
        skinned in 0_u64..2,
        lights in 0_u32..2,
    ) {
        let digest = |index: u32| Digest::of(&(bits >> index & 1));
        let scene = SceneFacts { rigid_voxels: rigid, skinned_voxels: skinned, lights, ..RIGID };
        let mut settings = Settings::default();
        settings.method.look.view = VIEWS[before];
        let mut held = Held::default();
        held.hold_all(&plan(&[Asked::new(scene, settings.clone())], &held));
        settings.method.look.view = VIEWS[view];
        settings.method.look.accuracy = accuracy;
        let mut asked = Asked::new(scene, settings);
        asked.contents = Contents {
            caches: digest(0), residents: digest(1), rigid: digest(2), skinned: digest(3), placed: digest(4),
            lights: digest(5), shadow_maps: digest(6), camera: digest(7), exact: (bits >> 8 == 1).then(other),
        };
        let plan = plan(&[asked], &held);
        let runs = |pass| plan.runs(pass);
        prop_assert!(PICTURES.into_iter().filter(|&pass| runs(pass)).count() <= 1);
        prop_assert!(!(runs(Pass::GatherNearest) && runs(Pass::GatherSplit)));
        prop_assert_eq!(runs(Pass::MarkLeaves), runs(Pass::AverageNodes));
        prop_assert!(!(runs(Pass::TransformRigid) || runs(Pass::TransformSkinned)) || runs(Pass::MarkLeaves));
        for planned in plan.to_run() {
            for (part, key) in planned.key.inputs() {
                held_or_before(&plan, &held, (planned.part, part), key)?;
            }
        }
    }
}

fn held_or_before(
    plan: &FramePlan,
    held: &Held,
    (made, from): (Part, Part),
    key: &octolume::plan::Key,
) -> Result<(), TestCaseError> {
    let runs = plan.to_run().iter().any(|planned| planned.part == from && planned.key == *key);
    prop_assert!(from < made && (runs || held.holds(from, key)), "{made:?} from {from:?}");
    Ok(())
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
