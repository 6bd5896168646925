//! Hidden objects: gone from every result, at no cost, and back again without voxelizing.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;
use octolume::engine::Engine;
use octolume::gpu::Gpu;
use octolume::plan::{FramePlan, Pass, State};
use octolume::prepare::{ExactVoxels, Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Mesh, Node, OrbitCamera, Scene, Trs};
use octolume::settings::{MotionSettings, Settings, View, Visibility};

use crate::device;
use crate::scenes::{at, channel, clip, cube, cube_scene, node, scaled};

const SIZE_PX: [u32; 2] = [48, 32];

/// A cube that slides (node 0), and one inside its bounds (node 1) with a mesh of its own, so that
/// the grid is the same without it.
fn scene() -> Scene {
    let mut scene = cube_scene(Trs::default());
    let slide = channel(
        octolume::scene::Property::Translation,
        octolume::scene::Interpolation::Linear,
        &[0.0, 1.0],
        &[0.0, 0.0, 0.0, 0.5, 0.0, 0.0],
    );
    scene.clips.push(clip(vec![slide]));
    scene.meshes.push(Mesh { name: "inner".to_owned(), primitives: vec![cube()] });
    scene.nodes.push(Node { mesh: Some(1), ..node(None, scaled(0.4, 0.4, 0.4)) });
    scene
}

fn without(nodes: &[usize]) -> Scene {
    let mut scene = scene();
    nodes.iter().for_each(|&node| scene.nodes[node].mesh = None);
    scene
}

fn settings() -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    let eye = DVec3::new(1.0, 2.0, 5.0);
    settings.shot.camera = Some(OrbitCamera::new(eye, DVec3::ZERO, 45.0));
    settings
}

fn showing_only(node: usize) -> Settings {
    let mut settings = settings();
    settings.shot.visibility.only = BTreeSet::from([node]);
    settings
}

fn hiding(nodes: &[usize]) -> Settings {
    let mut settings = settings();
    settings.shot.visibility.hidden = nodes.iter().copied().collect();
    settings
}

fn prepared(scene: Scene) -> Arc<Prepared> {
    let prepared = prepare(Arc::new(scene), &settings().method.discretization, None, &Progress::default());
    Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")))
}

fn engine(scene: Scene) -> Engine {
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(prepared(scene)));
    engine
}

fn frame(engine: &mut Engine, settings: &Settings) -> FramePlan {
    engine.request(settings, SIZE_PX).expect("a request");
    let plan = engine.plan().clone();
    engine.run_to_end().expect("a frame");
    plan
}

fn dispatches(gpu: &Gpu) -> usize {
    gpu.counters().dispatches.values().map(|count| *count as usize).sum()
}

#[test]
fn what_is_hidden_is_not_in_the_voxels_and_comes_back_without_voxelizing() {
    let mut engine = engine(scene());
    let first = frame(&mut engine, &settings());
    assert!(first.runs(Pass::UploadCaches));
    let all = engine.read_voxels().expect("voxels");
    let plan = frame(&mut engine, &hiding(&[1]));
    assert!(!plan.runs(Pass::UploadCaches) && plan.runs(Pass::ObjectIo));
    let mut alone = self::engine(without(&[1]));
    frame(&mut alone, &settings());
    assert_eq!(engine.read_voxels(), alone.read_voxels());
    assert_eq!(engine.octree_report().map(|report| report.voxels), alone.octree_report().map(|report| report.voxels));
    assert_eq!(engine.read_image(), alone.read_image());
    assert!(!frame(&mut engine, &settings()).runs(Pass::UploadCaches));
    assert_eq!(engine.read_voxels().expect("voxels"), all);
}

#[test]
fn how_a_hidden_object_moves_costs_nothing() {
    let mut engine = engine(scene());
    let mut settings = hiding(&[0]);
    frame(&mut engine, &settings);
    settings.shot.motion.time_secs = 0.5;
    assert!(frame(&mut engine, &settings).is_idle());
    settings.shot.visibility = Visibility::default();
    assert!(frame(&mut engine, &settings).runs(Pass::TransformRigid));
}

#[test]
fn where_everything_is_hidden_nothing_runs_and_nothing_is_shown() {
    for view in [View::Voxels, View::Mesh, View::Ghost] {
        let mut engine = engine(scene());
        let mut shown = settings();
        shown.method.look.view = view;
        if view == View::Ghost {
            let prepared = Arc::clone(engine.prepared().expect("a scene"));
            let exact =
                prepared.exact(&shown.shot.motion, &Default::default(), &Progress::default()).expect("an exact set");
            engine.offer_exact(Arc::new(exact));
        }
        frame(&mut engine, &shown);
        let (picture, voxels) = (engine.read_image().expect("a picture"), engine.read_voxels());
        let before = dispatches(engine.gpu());
        let mut hidden = shown.clone();
        hidden.shot.visibility = hiding(&[0, 1]).shot.visibility;
        let plan = frame(&mut engine, &hidden);
        assert!(plan.rows.iter().all(|row| row.state == State::Skip), "{plan:?}");
        assert!(engine.shows_nothing() && engine.image().is_none() && engine.octree_report().is_none());
        assert!(engine.read_voxels().expect("none").cells.is_empty());
        let empty = engine.read_image().expect("background");
        assert_eq!(empty.dimensions(), (SIZE_PX[0], SIZE_PX[1]));
        assert_eq!(empty.pixels().collect::<std::collections::HashSet<_>>().len(), 1);
        assert_eq!(picture.get_pixel(0, 0), empty.get_pixel(0, 0), "the background of {view:?}");
        frame(&mut engine, &shown);
        assert_eq!((engine.read_image().expect("a picture"), engine.read_voxels()), (picture, voxels));
        assert_eq!(dispatches(engine.gpu()), before, "what was there before was kept, {view:?}");
    }
}

#[test]
fn the_mesh_view_draws_and_uploads_what_is_shown_alone() {
    let mesh = |mut settings: Settings| {
        settings.method.look.view = View::Mesh;
        settings
    };
    let bytes = |engine: &Engine| -> u64 {
        let meshes = engine.memory().into_iter().filter(|buffer| buffer.label.starts_with("mesh vertices"));
        meshes.map(|buffer| buffer.bytes).sum()
    };
    let mut engine = engine(scene());
    frame(&mut engine, &mesh(hiding(&[1])));
    let mut alone = self::engine(without(&[1]));
    frame(&mut alone, &mesh(settings()));
    assert_eq!(engine.read_image(), alone.read_image());
    assert_eq!(bytes(&engine), bytes(&alone));
    assert!(frame(&mut engine, &mesh(settings())).runs(Pass::DrawMesh));
    let mut both = self::engine(scene());
    frame(&mut both, &mesh(settings()));
    assert_eq!(engine.read_image(), both.read_image());
    assert!(bytes(&engine) > bytes(&alone));
}

#[test]
fn exact_voxels_and_accuracy_are_of_what_is_shown() {
    let (both, alone) = (prepared(scene()), prepared(without(&[1])));
    let motion = MotionSettings { time_secs: 0.37, ..MotionSettings::default() };
    let none = Default::default();
    let hidden = both.hidden(&hiding(&[1]).shot.visibility, &both.pose(&motion).expect("poses")).expect("known nodes");
    let exact = both.exact(&motion, &hidden, &Progress::default()).expect("an exact set");
    let cells = |exact: ExactVoxels| (exact.bits, exact.count, exact.warnings);
    let of_alone = alone.exact(&motion, &none, &Progress::default()).expect("an exact set");
    assert_eq!(cells(exact.clone()), cells(of_alone.clone()));
    let surface = |prepared: &Prepared, hidden| prepared.exact_voxels(&motion, hidden, &Progress::default());
    assert_eq!(surface(&both, &hidden), surface(&alone, &none));
    let accuracy = |scene: Scene, exact: &ExactVoxels, mut settings: Settings| {
        let mut engine = engine(scene);
        (settings.method.look.accuracy, settings.shot.motion) = (true, motion.clone());
        engine.offer_exact(Arc::new(exact.clone()));
        frame(&mut engine, &settings);
        let report = engine.accuracy().expect("both filters");
        [report.nearest, report.split].map(|filter| filter.map(|f| (f.voxels, f.leaves, f.holes, f.spill)))
    };
    assert_eq!(accuracy(scene(), &exact, hiding(&[1])), accuracy(without(&[1]), &of_alone, settings()));
}

#[test]
fn nodes_that_the_scene_does_not_have_are_refused() {
    let mut engine = engine(scene());
    let error = engine.request(&hiding(&[2]), SIZE_PX).expect_err("no such node").to_string();
    assert!(error.contains("node 2") && error.contains("0 to 1"), "{error}");
    assert!(engine.request(&showing_only(7), SIZE_PX).is_err());
}

#[test]
fn a_node_is_framed_with_what_is_below_it() {
    let mut scene = scene();
    scene.nodes.push(node(None, at(9.0, 0.0, 0.0)));
    scene.nodes.push(Node { mesh: Some(1), ..node(Some(2), at(0.0, 1.0, 0.0)) });
    scene.nodes.push(node(Some(3), at(3.0, 0.0, 0.0)));
    let prepared = prepared(scene);
    let below = |node| prepared.bounds_below(node, &MotionSettings::default()).expect("a pose").expect("a box");
    assert_eq!((below(2).min, below(2).max), (DVec3::new(8.0, 0.0, -1.0), DVec3::new(10.0, 2.0, 1.0)));
    let empty = below(4);
    assert_eq!(empty.center(), DVec3::new(12.0, 1.0, 0.0));
    assert!(empty.size().min_element() > 0.0, "a place has room around it");
}

#[test]
fn what_comes_back_into_pages_that_others_lay_in_is_moved_again() {
    let prepared = &crate::walks::scenes::prepared()[0];
    let new = || {
        let mut engine = Engine::new(Arc::new(device::open()));
        engine.set_prepared(Some(Arc::clone(prepared)));
        engine
    };
    // A rigid object, a skinned one in its segments, and the rigid one again.
    let alone = [2, 3, 2].map(showing_only);
    let mut engine = new();
    for settings in &alone {
        frame(&mut engine, settings);
        let mut fresh = new();
        frame(&mut fresh, settings);
        assert_eq!(engine.read_voxels(), fresh.read_voxels());
        assert_eq!(engine.read_image(), fresh.read_image());
    }
}
