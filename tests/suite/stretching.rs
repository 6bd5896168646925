//! What no rigid motion of voxels can show is voxelized every frame, object by object; everything else is moved.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;
use octolume::engine::Engine;
use octolume::plan::Pass;
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Channel, Interpolation, Material, Mesh, Node, Property, Scene, builtin, load};
use octolume::settings::{Filter, Settings, Stretching, View};

use crate::device;
use crate::discretizers::{assert_exact, voxels};
use crate::real_scenes::real_scenes;
use crate::scenes::{at, channel, clip, cube, node};

fn settings(time_secs: f64) -> Settings {
    let mut settings = Settings::default();
    settings.method.discretization.grid = 64;
    settings.shot.motion.time_secs = time_secs;
    settings
}

fn elastic(settings: &Settings) -> Prepared {
    let bytes = builtin::make("elastic", 1).expect("a known name").expect("is made");
    let scene = load::open_bytes("elastic", &bytes, None, &Progress::default()).expect("opens");
    prepare(Arc::new(scene), settings, None, &Progress::default()).expect("it fits")
}

fn engine(prepared: Prepared) -> Engine {
    let mut engine = Engine::new(Arc::new(device::open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    engine
}

/// `settings`, with only these nodes shown.
fn only(settings: &Settings, scene: &Scene, names: &[&str]) -> Settings {
    let mut only = settings.clone();
    let numbers = names.iter().map(|name| scene.nodes.iter().position(|node| node.name == *name).expect("a node"));
    only.shot.visibility.only = numbers.collect();
    only
}

const STRETCHING: [&str; 3] = ["heart", "ball", "block"];
const MOVING: [&str; 2] = ["floor", "ring"];

#[test]
fn what_stretches_or_morphs_is_named_and_all_else_is_moved() {
    let prepared = elastic(&settings(0.5));
    let unmovable = prepared.objects.iter().filter_map(|object| Some((&*object.object.name, object.unmovable?)));
    let told: Vec<String> = unmovable.map(|(name, why)| format!("{name} {why}")).collect();
    let expected =
        ["heart stretches by up to ", "ball has morph targets that move it by up to ", "block stretches by up to "];
    assert_eq!(told.len(), expected.len(), "{told:?}");
    assert!(told.iter().zip(expected).all(|(told, expected)| told.starts_with(expected)), "{told:?}");
    let mut engine = engine(prepared);
    let mut settings = settings(0.5);
    engine.request(&settings, [16, 16]).expect("a request");
    assert_eq!((engine.voxelized().len(), engine.left_out()), (3, Vec::new()));
    settings.method.discretization.stretching = Stretching::Move;
    engine.request(&settings, [16, 16]).expect("a request");
    assert_eq!((engine.voxelized().len(), engine.left_out().len()), (0, 3));
}

#[test]
fn cells_are_those_of_moved_objects_and_exactly_those_of_the_others() {
    for time in [0.25, 1.0, 1.6] {
        let mut settings = settings(time);
        settings.method.discretization.grid = 128;
        let scene = elastic(&settings).scene;
        let alone = only(&settings, &scene, &STRETCHING);
        assert_exact(&format!("elastic at {time} s"), elastic(&settings), &alone);
        let mut engine = engine(elastic(&settings));
        let [all, stretching, moving] = [settings.clone(), alone, only(&settings, &scene, &MOVING)]
            .map(|settings| voxels(&mut engine, &settings).cells.into_iter().collect::<BTreeSet<_>>());
        assert_eq!(all, &stretching | &moving);
    }
}

/// The order of voxels, the room for them and what was there before change no bit.
#[test]
fn a_mixed_octree_is_the_same_whatever_came_before() {
    let wanted = settings(0.7);
    let mut fresh = engine(elastic(&wanted));
    let expected = voxels(&mut fresh, &wanted);
    assert!(expected.cells.len() > 3_000);
    let mut scrubbed = engine(elastic(&wanted));
    for time in [1.9, 0.0, 0.3] {
        voxels(&mut scrubbed, &settings(time));
    }
    assert_eq!(voxels(&mut scrubbed, &wanted), expected);
    let mut short = engine(elastic(&wanted));
    short.underestimate(0.4);
    voxels(&mut short, &settings(1.9));
    assert_eq!(voxels(&mut short, &wanted), expected);
}

#[test]
fn each_half_is_made_again_only_where_it_changes() {
    let first = settings(0.5);
    let mut engine = engine(elastic(&first));
    let runs = |engine: &mut Engine, settings: &Settings| {
        engine.request(settings, [16, 16]).expect("a request");
        let plan = engine.plan();
        let runs = [Pass::TransformRigid, Pass::VoxelizeTriangles, Pass::JoinVoxels].map(|pass| plan.runs(pass));
        engine.run_to_end().expect("a frame");
        runs
    };
    assert_eq!(runs(&mut engine, &first), [true; 3]);
    assert_eq!(runs(&mut engine, &first), [false; 3]);
    assert_eq!(runs(&mut engine, &settings(0.6)), [true; 3]);
    let scene = elastic(&first).scene;
    let without_ring = only(&settings(0.6), &scene, &["floor", "heart", "ball", "block"]);
    assert_eq!(runs(&mut engine, &without_ring), [true, false, true], "what stretches stays");
    let moved_alone = only(&settings(0.6), &scene, &MOVING);
    assert_eq!(runs(&mut engine, &moved_alone), [true, false, false]);
}

/// A glowing box that stays and one that grows: light of both, as if all were voxelized.
#[test]
fn voxels_of_both_kinds_emit() {
    let mut scene = Scene { name: "glowing".to_owned(), ..Scene::default() };
    for emissive in [[5.0, 2.0, 0.5], [0.25, 1.0, 4.0]] {
        let material = Some(scene.materials.len());
        scene.materials.push(Material { emissive, ..Material::default() });
        let primitive = octolume::scene::Primitive { material, ..cube() };
        scene.meshes.push(Mesh { name: "cube".to_owned(), primitives: vec![primitive] });
    }
    scene.nodes = vec![
        Node { mesh: Some(0), ..node(None, at(0.03, 0.01, 0.02)) },
        Node { mesh: Some(1), ..node(None, at(5.01, 0.52, 0.33)) },
    ];
    let grown = channel(Property::Scale, Interpolation::Linear, &[0.0, 1.0], &[[1.0; 3], [2.0; 3]].concat());
    scene.clips = vec![clip(vec![Channel { node: 1, ..grown }])];
    let scene = Arc::new(scene);
    let mut settings = settings(0.37);
    settings.method.discretization.filter = Filter::Nearest;
    settings.method.look.view = View::Voxels;
    settings.method.look.color = octolume::settings::ColorBy::Radiance;
    let light = |stretching, discretizer| {
        let mut settings = settings.clone();
        settings.method.discretization.stretching = stretching;
        settings.method.discretization.discretizer = discretizer;
        let mut engine = engine(prepare(Arc::clone(&scene), &settings, None, &Progress::default()).expect("it fits"));
        engine.request(&settings, [160, 90]).expect("a request");
        engine.run_to_end().expect("a frame");
        assert_eq!(engine.voxelized().len(), usize::from(stretching == Stretching::Voxelize));
        engine.read_image().expect("a picture")
    };
    use octolume::settings::Discretizer::{Transform, Voxelize};
    let mixed = light(Stretching::Voxelize, Transform);
    let colors: BTreeSet<[u8; 4]> = mixed.pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 2, "both boxes glow: {colors:?}");
    assert_eq!(mixed, light(Stretching::Move, Voxelize));
}

/// Percents of the exact cells that are missed, by what is done with stretching objects.
fn holes(scene: &Arc<Scene>, settings: &Settings) -> [f64; 2] {
    [Stretching::Move, Stretching::Voxelize].map(|stretching| {
        let mut settings = settings.clone();
        settings.method.discretization.stretching = stretching;
        settings.method.look.accuracy = true;
        let prepared = prepare(Arc::clone(scene), &settings, None, &Progress::default()).expect("it fits");
        let pose = prepared.pose(&settings.shot.motion).expect("poses");
        let hidden = prepared.hidden(&settings.shot.visibility, &pose).expect("known");
        let exact = prepared.exact(&settings.shot.motion, &hidden, &Progress::default()).expect("exact voxels");
        let count = exact.count as f64;
        let mut engine = engine(prepared);
        engine.offer_exact(Arc::new(exact));
        engine.request(&settings, [16, 16]).expect("a request");
        engine.run_to_end().expect("a frame");
        let split = engine.accuracy().and_then(|report| report.split).expect("measured");
        100.0 * split.holes.expect("compared") as f64 / count
    })
}

#[test]
fn holes_of_what_stretches_are_closed() {
    let mut wanted = settings(0.5);
    wanted.method.discretization.grid = 256;
    let [moved, mixed] = holes(&elastic(&wanted).scene, &wanted);
    println!("elastic at 256: {moved:.3} % moved, {mixed:.3} % mixed");
    assert!(moved > 2.0 && mixed < 0.1, "elastic: {moved} % moved, {mixed} % mixed");
    let Some(folder) = real_scenes() else { return };
    let fox = load::open(&folder.join("Fox/Fox.glb"), &Progress::default()).expect("opens");
    wanted.method.discretization.grid = 512;
    wanted.shot.motion.time_secs = 0.854;
    let [moved, mixed] = holes(&Arc::new(fox), &wanted);
    println!("Fox at 512: {moved:.3} % moved, {mixed:.3} % mixed");
    assert!(moved > 1.0 && mixed < 0.1, "Fox: {moved} % moved, {mixed} % mixed");
}

/// A skin that only turns is moved, however it is bent about its joints: a cube on one joint.
#[test]
fn what_only_turns_is_moved() {
    let prepared = elastic(&settings(0.0));
    let of = |name: &str| prepared.objects.iter().find(|object| object.object.name == name).expect("an object");
    assert!(of("ring").unmovable.is_none() && of("floor").unmovable.is_none());
    assert!(of("ring").object.stretch.abs_diff_eq(glam::DMat3::from_diagonal(DVec3::ONE), 1e-9));
}
