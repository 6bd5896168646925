//! The plan's rules of light, one by one; then what the engine really did, counted against it.

use glam::DVec3;
use octolume::plan::{Asked, Pass, SceneFacts, State};
use octolume::scene::{Light, LightKind, Material, OrbitCamera, Scene, Trs};
use octolume::settings::lighting::{LightEdit, Opacity, Shadows, SunShines};
use octolume::settings::{ColorBy, Lookup, MethodSettings, Sampling, Settings, SliceValue, View};
use octolume::stages::sample::Sampler;

use crate::plan::{Counted, RIGID, changed, first, other, reason, running};
use crate::scenes::{cube_scene, node, sliding_scene};

const LIT: SceneFacts = SceneFacts { lights: 1, ..RIGID };
const LIGHT_PASSES: [Pass; 8] = [
    Pass::GatherEmission,
    Pass::DrawShadows,
    Pass::Illuminate,
    Pass::GatherSky,
    Pass::InjectLight,
    Pass::AverageLight,
    Pass::Bounces,
    Pass::AverageIrradiance,
];

fn radiance() -> Settings {
    let mut settings = Settings::default();
    settings.method.look.color = ColorBy::Radiance;
    settings
}

#[test]
fn light_that_nobody_looks_at_costs_nothing() {
    let lit = SceneFacts { emissive_voxels: 5, ..LIT };
    let plan = first(&lit, &Settings::default());
    for pass in LIGHT_PASSES {
        assert_eq!(reason(&plan, pass), (State::Skip, "light is not looked at"));
    }
}

#[test]
fn no_light_and_no_emission_leave_the_voxels_dark_without_any_pass() {
    let plan = first(&RIGID, &radiance());
    for pass in LIGHT_PASSES {
        assert_eq!(reason(&plan, pass), (State::Skip, "no light and no emission"));
    }
    assert!(plan.runs(Pass::MarchVoxels) && !plan.runs(Pass::MarchLight));
}

#[test]
fn each_kind_of_light_calls_for_its_own_passes() {
    let of = |scene: &SceneFacts, settings: &Settings| {
        let plan = first(scene, settings);
        LIGHT_PASSES.into_iter().filter(|&pass| plan.runs(pass)).collect::<Vec<_>>()
    };
    use Pass::{
        AverageIrradiance, AverageLight, Bounces, DrawShadows, GatherEmission, GatherSky, Illuminate, InjectLight,
    };
    assert_eq!(of(&LIT, &radiance()), [DrawShadows, Illuminate, InjectLight, AverageLight]);
    let emissive = SceneFacts { emissive_voxels: 9, ..RIGID };
    assert_eq!(of(&emissive, &radiance()), [GatherEmission, InjectLight, AverageLight]);
    let mut settings = radiance();
    settings.method.lighting.emission = 0.0;
    assert_eq!(of(&emissive, &settings), [], "switched off");
    settings.method.lighting.sky_nits = [1.0; 3];
    assert_eq!(of(&RIGID, &settings), [GatherSky, InjectLight, AverageLight]);
    settings.method.lighting.bounces = 2;
    settings.method.look.color = ColorBy::Irradiance;
    assert_eq!(of(&RIGID, &settings), [GatherSky, InjectLight, AverageLight, Bounces, AverageIrradiance]);
}

#[test]
fn shadow_maps_are_drawn_only_where_they_are_read() {
    let mut settings = radiance();
    for (shadows, why) in [(Shadows::March, "shadows are marched"), (Shadows::Off, "shadows are off")] {
        settings.method.lighting.shadows = shadows;
        assert_eq!(reason(&first(&LIT, &settings), Pass::DrawShadows), (State::Skip, why));
    }
    settings.method.look.view = View::ShadowMap;
    assert_eq!(running(&first(&LIT, &settings)), [Pass::DrawShadows, Pass::ShowShadowMap], "no octree");
    let bare = SceneFacts { triangles: 0, ..LIT };
    assert!(first(&bare, &settings).is_idle());
}

#[test]
fn an_edited_light_is_injected_and_averaged_alone_and_a_moved_one_mapped_too() {
    let settings = radiance();
    let edited = |asked: &mut Asked| asked.contents.lights = other();
    let ran = [Pass::Illuminate, Pass::InjectLight, Pass::AverageLight, Pass::MarchLight];
    assert_eq!(running(&changed(&LIT, &settings, edited)), ran);
    let moved = |asked: &mut Asked| (asked.contents.lights, asked.contents.shadow_maps) = (other(), other());
    assert!(changed(&LIT, &settings, moved).runs(Pass::DrawShadows));
    assert!(changed(&LIT, &settings, |_| {}).is_idle(), "all still");
    assert_eq!(running(&changed(&LIT, &settings, |asked| asked.contents.camera = other())), [Pass::MarchLight]);
}

#[test]
fn pointers_are_linked_where_they_are_followed_or_shown() {
    let mut settings = Settings::default();
    assert_eq!(reason(&first(&RIGID, &settings), Pass::LinkNodes).0, State::Skip);
    settings.method.look.pointers = true;
    assert!(first(&RIGID, &settings).runs(Pass::LinkNodes));
    settings.method.look.pointers = false;
    settings.method.look.view = View::Slice;
    assert!(!first(&RIGID, &settings).runs(Pass::LinkNodes), "ranks need none");
    settings.method.look.slice.lookup = Lookup::NodePointers;
    assert!(first(&RIGID, &settings).runs(Pass::LinkNodes));
}

#[test]
fn a_slice_of_occupancy_needs_the_store_but_no_light() {
    let mut settings = Settings::default();
    settings.method.look.view = View::Slice;
    settings.method.look.slice.value = SliceValue::Occupancy;
    let plan = first(&RIGID, &settings);
    assert!(plan.runs(Pass::InjectLight) && plan.runs(Pass::AverageLight) && plan.runs(Pass::SliceOctree));
    assert_eq!(reason(&plan, Pass::Illuminate), (State::Skip, "only opacity is looked at"));
}

/// A cube under a light that shines straight down on it.
fn lamp_scene() -> Scene {
    let mut scene = cube_scene(Trs::default());
    let lamp = Light { name: "lamp".to_owned(), kind: LightKind::Directional, color: [1.0; 3], intensity: 10.0 };
    scene.lights.push(lamp);
    scene.nodes.push(octolume::scene::Node { light: Some(0), ..node(None, Trs::default()) });
    scene
}

fn show_radiance(counted: &mut Counted) {
    let discretization = counted.settings.method.discretization;
    counted.settings.method = MethodSettings { discretization, ..radiance().method };
}

fn labels(counted: &Counted) -> Vec<String> {
    counted.engine.memory().into_iter().map(|buffer| buffer.label).collect()
}

#[test]
fn a_scene_in_the_dark_has_no_buffer_of_light() {
    let mut counted = Counted::new(cube_scene(Trs::default()));
    show_radiance(&mut counted);
    counted.settings.method.lighting.sun.shines = SunShines::Never;
    counted.frame();
    let made = labels(&counted);
    assert!(
        made.iter().all(|label| !label.contains("light") && !label.contains("irradiance") && !label.contains("shadow")),
        "{made:?}"
    );
}

#[test]
fn frames_in_light_run_what_the_plan_says_and_nothing_when_still() {
    let mut counted = Counted::new(lamp_scene());
    show_radiance(&mut counted);
    counted.settings.method.lighting.bounces = 1;
    let (first, _) = counted.frame();
    assert!(first.runs(Pass::DrawShadows) && first.runs(Pass::Bounces) && first.runs(Pass::MarchLight));
    assert!(counted.frame().0.is_idle());
    counted.settings.shot.camera = Some(OrbitCamera::default());
    assert_eq!(running(&counted.frame().0), [Pass::MarchLight]);
    let edit = LightEdit { on: true, kind: LightKind::Directional, color: [1.0, 0.5, 0.0], intensity: 3.0 };
    counted.settings.method.lighting.edits.insert(1, edit);
    let ran = [Pass::Illuminate, Pass::InjectLight, Pass::AverageLight, Pass::Bounces, Pass::MarchLight];
    assert_eq!(running(&counted.frame().0), ran);
    counted.settings.method.look.color = ColorBy::Irradiance;
    assert_eq!(running(&counted.frame().0), [Pass::AverageIrradiance, Pass::MarchLight]);
    counted.settings.method.lighting.opacity = Opacity::Directional;
    assert!(counted.frame().0.runs(Pass::AverageLight));
    assert!(counted.frame().0.is_idle());
}

#[test]
fn emission_is_gathered_once_a_build() {
    let mut scene = cube_scene(Trs::default());
    scene.materials.push(Material { emissive: [4.0, 2.0, 0.0], ..Material::default() });
    scene.meshes[0].primitives[0].material = Some(0);
    let mut counted = Counted::new(scene);
    show_radiance(&mut counted);
    assert!(counted.frame().0.runs(Pass::GatherEmission));
    assert!(!labels(&counted).iter().any(|label| label.contains("shadow")), "our own sun stays away");
    counted.settings.method.lighting.emission = 2.0;
    let again = counted.frame().0;
    assert!(again.runs(Pass::InjectLight) && !again.runs(Pass::GatherEmission));
    // 4 nits times two, mean over a scene that emits everywhere: an eighth of green is blue's nothing.
    let shown = counted.engine.exposure();
    let mean = 0.18 / shown;
    let expected = octolume::color::luminance([8.0, 4.0, 0.0]);
    assert!((mean - expected).abs() < 1e-3 * expected, "{mean} is not {expected}");
}

#[test]
fn the_camera_changes_no_bit_of_light() {
    let mut counted = Counted::new(lamp_scene());
    show_radiance(&mut counted);
    counted.settings.method.lighting.bounces = 1;
    counted.frame();
    let places = [[32.0, 32.0, 32.0, 4.0], [20.0, 31.0, 30.0, 1.0], [16.5, 40.0, 16.5, 9.0]];
    let sampler = Sampler { sampling: Sampling::Quadrilinear, ..Sampler::default() };
    let sampled = |counted: &Counted| counted.engine.sample(&sampler, [0.0, 1.0, 0.0], &places).expect("light").0;
    let before = sampled(&counted);
    counted.settings.shot.camera = Some(OrbitCamera::default());
    // Samples are no pass of a frame, so this one is not counted.
    counted.engine.request(&counted.settings, [32, 32]).expect("a request");
    counted.engine.run_to_end().expect("a frame");
    assert_eq!(sampled(&counted), before);
    assert!(before.iter().any(|sample| sample[0] > 0.0));
}

#[test]
fn what_came_before_changes_no_bit_of_light() {
    let settings_at = |counted: &mut Counted, time_secs: f64| {
        counted.settings.shot.motion.time_secs = time_secs;
        counted.frame();
        counted.engine.read_image().expect("a picture").into_raw()
    };
    let lit = |scene: Scene| {
        let mut counted = Counted::new(scene);
        show_radiance(&mut counted);
        counted.settings.method.lighting.bounces = 2;
        counted.settings.method.lighting.sky_nits = [100.0; 3];
        counted.settings.method.lighting.sun.direction = DVec3::new(0.2, -1.0, 0.1).to_array();
        counted
    };
    let fresh = settings_at(&mut lit(sliding_scene()), 0.7);
    let mut played = lit(sliding_scene());
    for time_secs in [0.0, 1.1, 0.3] {
        settings_at(&mut played, time_secs);
    }
    assert!(settings_at(&mut played, 0.7) == fresh);
}
