//! Which lights a pose has, where they are, and why the others do not shine.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};
use octolume::engine::Engine;
use octolume::lights::{KnownLight, LightSource, PosedLight, Shines, known_lights, left_out, posed_lights, sun_shines};
use octolume::prepare::prepare;
use octolume::progress::Progress;
use octolume::scene::animation::{Channel, Clip, Interpolation, Property};
use octolume::scene::{Light, LightKind, LocalTransform, Node, Scene, Trs};
use octolume::settings::Lighting;
use octolume::settings::lighting::{AddedLight, LightEdit, SunShines};

fn node(name: &str, parent: Option<usize>, light: Option<usize>, local: LocalTransform) -> Node {
    Node { name: name.to_owned(), parent, local, mesh: None, skin: None, camera: None, light, is_visible: true }
}

fn at(x: f64, y: f64, z: f64) -> LocalTransform {
    LocalTransform::Trs(Trs { translation: DVec3::new(x, y, z), ..Trs::default() })
}

/// A lamp post (0) with a bulb (1) and a spot (2), and the sun (3).
fn street() -> Scene {
    let light = |name: &str, kind, intensity| Light { name: name.to_owned(), kind, color: [1.0, 0.5, 0.25], intensity };
    Scene {
        name: "street".to_owned(),
        nodes: vec![
            node("post", None, None, at(1.0, 0.0, 0.0)),
            node("bulb", Some(0), Some(0), at(0.0, 2.0, 0.0)),
            node("spot", Some(0), Some(1), at(0.0, 3.0, 0.0)),
            node("sky", None, Some(2), at(0.0, 0.0, 0.0)),
        ],
        lights: vec![
            light("warm", LightKind::POINT, 8.0),
            light("beam", LightKind::SPOT, 4.0),
            light("day", LightKind::Directional, 2.0),
        ],
        ..Scene::default()
    }
}

const NO_SUN: SunShines = SunShines::Never;

/// Without a sun of our own.
fn lighting() -> Lighting {
    let mut lighting = Lighting::default();
    lighting.sun.shines = NO_SUN;
    lighting
}

fn posed(scene: &Scene, lighting: &Lighting) -> Vec<PosedLight> {
    posed_lights(scene, &scene.pose(None, 0.0), lighting, &vec![true; scene.nodes.len()], false)
}

fn known(scene: &Scene, lighting: &Lighting) -> Vec<KnownLight> {
    known_lights(scene, &scene.pose(None, 0.0), lighting, &vec![true; scene.nodes.len()], false)
}

fn names(lights: &[PosedLight]) -> Vec<&str> {
    lights.iter().map(|light| light.name.as_str()).collect()
}

#[test]
fn lights_of_the_scene_stand_where_their_nodes_do_in_node_order() {
    let lights = posed(&street(), &lighting());
    assert_eq!(names(&lights), ["warm", "beam", "day"]);
    assert_eq!(lights.iter().map(|light| light.node).collect::<Vec<_>>(), [Some(1), Some(2), Some(3)]);
    assert_eq!(lights[0].position, DVec3::new(1.0, 2.0, 0.0));
    assert_eq!(lights[0].strength, DVec3::new(8.0, 4.0, 2.0), "colour times candela");
    assert_eq!((lights[1].position, lights[1].direction), (DVec3::new(1.0, 3.0, 0.0), DVec3::NEG_Z));
    assert_eq!(lights[2].direction, DVec3::NEG_Z);
}

#[test]
fn edits_change_a_light_by_its_node_and_leave_its_place() {
    let scene = street();
    let mut edited = lighting();
    let point = LightKind::Point { range: Some(6.0) };
    edited.edits.insert(1, LightEdit { on: true, kind: point, color: [0.0, 0.0, 1.0], intensity: 100.0 });
    edited.edits.insert(3, LightEdit { on: false, ..LightEdit::new(LightKind::Directional) });
    let lights = posed(&scene, &edited);
    assert_eq!(names(&lights), ["warm", "beam"]);
    assert_eq!((lights[0].kind, lights[0].strength), (point, DVec3::new(0.0, 0.0, 100.0)));
    let plain = posed(&scene, &lighting());
    assert_eq!((lights[0].position, &lights[1]), (plain[0].position, &plain[1]));
}

#[test]
fn our_sun_shines_where_nothing_else_does_or_as_it_is_told() {
    let mut dark = street();
    dark.nodes.iter_mut().for_each(|node| node.light = None);
    let automatic = Lighting::default();
    assert_eq!(names(&posed(&dark, &automatic)), ["sun"]);
    assert!(sun_shines(&dark, &automatic, false));
    assert!(!sun_shines(&dark, &automatic, true), "something emits");
    assert!(!sun_shines(&street(), &automatic, false), "there are lights");
    // Lights that are switched off are lights: the sun must not come up in their stead.
    let mut off = automatic.clone();
    for (node, light) in [(1, 0), (2, 1), (3, 2)] {
        let kind = street().lights[light].kind;
        off.edits.insert(node, LightEdit { on: false, ..LightEdit::new(kind) });
    }
    assert!(posed(&street(), &off).is_empty());
    for (shines, expected) in [(SunShines::Always, true), (SunShines::Never, false)] {
        let mut told = Lighting::default();
        told.sun.shines = shines;
        assert_eq!(sun_shines(&dark, &told, true), expected);
        assert_eq!(names(&posed(&street(), &told)).contains(&"sun"), expected);
    }
    let sun = &posed(&dark, &automatic)[0];
    assert!((sun.direction.length() - 1.0).abs() < 1e-15 && sun.node.is_none());
}

#[test]
fn added_lights_follow_those_of_the_scene_and_black_ones_shine_not() {
    let mut lighting = lighting();
    let direction = [0.0, -5.0, 0.0];
    let torch =
        AddedLight { direction, position: [1.0, 2.0, 3.0], ..AddedLight::new("torch".to_owned(), LightKind::SPOT) };
    let black = LightEdit { color: [0.0; 3], ..LightEdit::new(LightKind::POINT) };
    let coal = AddedLight { light: black, ..AddedLight::new("coal".to_owned(), LightKind::POINT) };
    lighting.added = vec![torch, coal];
    let lights = posed(&street(), &lighting);
    assert_eq!(names(&lights), ["warm", "beam", "day", "torch"]);
    assert_eq!((lights[3].position, lights[3].direction), (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Y));
    let states: Vec<_> = known(&street(), &lighting).iter().map(|light| (light.source, light.shines)).collect();
    assert_eq!(
        states[3..],
        [(LightSource::Sun, Shines::Off), (LightSource::Added(0), Shines::Yes), (LightSource::Added(1), Shines::Black),]
    );
}

#[test]
fn lights_of_hidden_nodes_are_off() {
    let scene = street();
    let pose = scene.pose(None, 0.0);
    let shown = [true, false, true, true];
    assert_eq!(names(&posed_lights(&scene, &pose, &lighting(), &shown, false)), ["beam", "day"]);
    let known = known_lights(&scene, &pose, &lighting(), &shown, false);
    assert_eq!(known[0].shines, Shines::Hidden);
}

#[test]
fn a_node_that_a_clip_moves_moves_its_light() {
    let mut scene = street();
    let half = (FRAC_PI_2 / 2.0).sin();
    let turn = Channel {
        node: 0,
        property: Property::Rotation,
        interpolation: Interpolation::Linear,
        times_secs: vec![0.0, 1.0],
        values: vec![0.0, 0.0, 0.0, 1.0, half, 0.0, 0.0, half],
    };
    scene.clips = vec![Clip { name: "fall".to_owned(), channels: vec![turn], duration_secs: 1.0 }];
    let shown = [true; 4];
    let lights = posed_lights(&scene, &scene.pose(Some(0), 1.0), &lighting(), &shown, false);
    // A quarter turn about x at (1, 0, 0): y becomes z, and −z becomes y.
    assert!((lights[0].position - DVec3::new(1.0, 0.0, 2.0)).length() < 1e-6, "{}", lights[0].position);
    assert!((lights[1].direction - DVec3::Y).length() < 1e-6, "{}", lights[1].direction);
    assert_eq!(lights[2], posed(&scene, &lighting())[2], "what does not hang on it stays");
}

#[test]
fn scaled_and_mirrored_nodes_scale_no_light_and_mirror_its_direction() {
    let mut scene = street();
    let turned = DQuat::from_rotation_y(FRAC_PI_2);
    for (scale, direction) in [
        (DVec3::splat(1000.0), DVec3::NEG_X),
        (DVec3::new(1.0, 1.0, 1e-3), DVec3::NEG_X),
        (DVec3::new(1.0, 1.0, -2.0), DVec3::X),
        (DVec3::new(-2.0, 1.0, 1.0), DVec3::NEG_X),
    ] {
        let matrix = DMat4::from_scale_rotation_translation(scale, turned, DVec3::ZERO);
        scene.nodes[3].local = LocalTransform::Matrix(matrix);
        let lights = posed(&scene, &lighting());
        assert!((lights[2].direction - direction).length() < 1e-12, "{scale}: {}", lights[2].direction);
        assert_eq!(lights[2].strength, DVec3::new(2.0, 1.0, 0.5), "{scale}");
    }
}

#[test]
fn a_light_without_a_finite_place_or_direction_is_left_out_and_named() {
    let mut scene = street();
    scene.nodes[1].local = at(f64::NAN, 0.0, 0.0);
    scene.nodes[2].local = LocalTransform::Matrix(DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0)));
    // A directional light needs no place.
    scene.nodes[3].local = at(f64::INFINITY, 0.0, 0.0);
    assert_eq!(names(&posed(&scene, &lighting())), ["day"]);
    let pose = scene.pose(None, 0.0);
    let sentences = left_out(&scene, &pose, &lighting(), &[true; 4]);
    let cause = "is left out: in this pose it has no finite place or no direction";
    assert_eq!(
        sentences,
        [format!("light \"warm\" of node \"bulb\" {cause}"), format!("light \"beam\" of node \"spot\" {cause}"),]
    );
    assert!(left_out(&scene, &pose, &lighting(), &[true, false, false, true]).is_empty(), "hidden ones are not missed");
}

#[test]
fn the_engine_names_lights_that_are_nowhere() {
    let mut scene = crate::scenes::cube_scene(Trs::default());
    scene.lights = street().lights;
    scene.nodes.push(node("lost", None, Some(0), at(f64::NAN, 0.0, 0.0)));
    let mut settings = octolume::settings::Settings::default();
    settings.method.discretization.grid = 64;
    let prepared =
        prepare(Arc::new(scene), &settings.method.discretization, None, &Progress::default()).expect("it fits");
    let mut engine = Engine::new(Arc::new(crate::device::open()));
    engine.set_prepared(Some(Arc::new(prepared)));
    engine.request(&settings, [1, 1]).expect("a request");
    let cause = "is left out: in this pose it has no finite place or no direction";
    assert_eq!(engine.left_out(), [format!("light \"warm\" of node \"lost\" {cause}")]);
    settings.shot.visibility.hidden.insert(1);
    engine.request(&settings, [1, 1]).expect("a request");
    assert!(engine.left_out().is_empty(), "hidden ones are not missed");
}
